#pragma once

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// The fields of the chosen operation, one below the other.
/// \return the parameter under the mouse or with the keyboard; null: none
[[nodiscard]] const Parameter* draw_form_fields(PanelContext& context, OperationForm& form);

}  // namespace vesselbench
