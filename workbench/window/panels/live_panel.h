#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// The part of a smoothing form that is seen while the model follows it: what the mouse drives, and
/// what the smoothing changes.
void draw_live_panel(PanelContext& context, const OperationForm& form);

/// The part of another form with quality graphs: of an operation that no model follows.
void draw_quality_panel(PanelContext& context, const OperationForm& form);

}  // namespace vesselbench
