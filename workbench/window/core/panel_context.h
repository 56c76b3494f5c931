#pragma once

#include <functional>
#include <string>

namespace vesselbench {

struct Shown;
class Thumbnails;
class Ui;
class Workplace;

/// What panels draw from, and where their requests go.
struct PanelContext {
    Ui& ui;
    Workplace& place;
    Shown& shown;
    std::string device;  ///< of OpenGL
    std::function<void(const std::string&)> to_clipboard;
    Thumbnails& thumbnails;
};

}  // namespace vesselbench
