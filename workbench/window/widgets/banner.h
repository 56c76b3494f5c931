#pragma once

#include <string>

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A line over the view: an icon, a text, and at its end up to two buttons.
struct Banner {
    const char* icon;
    Paint colour = 0;
    std::string text;
    std::string action = {};  ///< label of the button
    bool can_close = false;
    bool is_next = false;  ///< the action is what most users want
};

enum class BannerAnswer { None, Action, Close };

/// Wide enough for its text in one line [pixels].
[[nodiscard]] float width_of(const Ui& ui, const Banner& banner);

/// Tall enough for its text [pixels].
[[nodiscard]] float height_of(const Ui& ui, const Banner& banner, float width);

/// \return which of its buttons was pressed
BannerAnswer draw_banner(Ui& ui, const std::string& name, const Banner& banner,
                         const ScreenRect& rect);

}  // namespace vesselbench
