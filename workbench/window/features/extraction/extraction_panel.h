#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// The form's tab in which the iso-value is slid over the image's histogram, and the surface
/// follows.
void draw_extraction_panel(PanelContext& context, const OperationForm& form);

}  // namespace vesselbench
