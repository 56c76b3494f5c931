#pragma once

#include <functional>
#include <string>

namespace vesselbench {

class Core;
struct Shown;
class Thumbnails;
class Ui;
class Workplace;

/// What panels draw from, and where their requests go.
struct PanelContext {
    Ui& ui;
    Core& core;        ///< for features
    Workplace& place;  ///< the same, for what lies around them
    Shown& shown;
    std::string device;  ///< of OpenGL
    std::function<void(const std::string&)> to_clipboard;
    Thumbnails& thumbnails;
};

}  // namespace vesselbench
