#pragma once

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Where the parts of the window are.
struct Layout {
    ScreenRect window, tool_bar, rail, view, bottom, operation, status;
    bool compact = false;  ///< little room: short labels
};

/// \param width, height of the window [pixels] \param em size of the text [pixels]
[[nodiscard]] Layout layout_of(float width, float height, float em);

}  // namespace vesselbench
