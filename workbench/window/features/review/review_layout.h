#pragma once

#include <string>

#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A text at the review panel's indent.
void review_line(PanelContext& context, const std::string& words, Paint colour);

/// Begins a line of controls at the same indent.
/// \param count of equally wide controls in it, with gaps of a grid unit
/// \return width of one [pixels]
[[nodiscard]] float begin_review_controls(PanelContext& context, int count);

/// Puts ImGui's cursor beside the last control of such a line.
void next_review_control(PanelContext& context);

}  // namespace vesselbench
