#pragma once

#include <functional>
#include <string>

#include "workbench/window/core/panel_context.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// Where what is typed into a form's fields goes.
struct FieldSink {
    std::string prefix;  ///< of the names of the fields' items
    std::function<void(const std::string& parameter, const std::string& text)> set;
    bool in_view = true;  ///< false: without places and files, which need the view and a dialog
};

/// The fields of a form, one below the other.
/// \return the parameter under the mouse or with the keyboard; null: none
[[nodiscard]] const Parameter* draw_form_fields(PanelContext& context, const OperationForm& form,
                                                const FieldSink& sink);

}  // namespace vesselbench
