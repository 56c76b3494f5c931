#pragma once

#include <string>

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A row of a list: an icon, a title, at its right end a short text, and below a detail.
struct RowLook {
    const char* icon = "";
    Paint icon_colour = 0;  ///< 0: of muted texts
    std::string title;
    std::string detail = {};  ///< second line; empty: one line only
    std::string right = {};
    bool selected = false;
    bool strong = false;  ///< the title in the medium font
    bool enabled = true;  ///< else muted, and not to be clicked
    float indent = 0.0F;  ///< [pixels]
    std::string help = {};
};

/// Draws a row over the width that is left. \return true when it is clicked
bool row(Ui& ui, const std::string& name, const RowLook& look);

/// [pixels] \param detail whether it has a second line
[[nodiscard]] float row_height(const Ui& ui, bool detail);

/// True if the last row was clicked twice.
[[nodiscard]] bool row_double_clicked();

}  // namespace vesselbench
