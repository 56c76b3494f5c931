#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// Suggestions for the parameters of a form whose operation has a search, and its model quality
/// graphs or bars (thesis 6.5.3-6.5.5): a click or a drag in one sets the parameter.
void draw_quality(PanelContext& context, const OperationForm& form);

}  // namespace vesselbench
