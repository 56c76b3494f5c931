#pragma once

struct ImFont;

namespace vesselbench {

/// The window's fonts; each has the icons of icons.h. They belong to the ImGui context.
struct Fonts {
    ImFont* regular = nullptr;
    ImFont* medium = nullptr;  ///< for emphasis
    ImFont* small = nullptr;   ///< secondary texts
    ImFont* heading = nullptr;
    ImFont* title = nullptr;
};

/// Replaces the fonts of the current ImGui context; the device's texture must be made again.
/// \param em size of the text [pixels]
[[nodiscard]] Fonts make_fonts(float em);

}  // namespace vesselbench
