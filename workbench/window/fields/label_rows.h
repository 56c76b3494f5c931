#pragma once

#include "workbench/window/core/panel_context.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// True if a field takes labels, and those that there are can be listed.
[[nodiscard]] bool lists_labels(const PanelContext& context, const FormField& field);

/// How many of them are taken: "2 of 5". \pre lists_labels
void draw_label_count(PanelContext& context, const FormField& field);

/// The labels with colour, name, volume and whether they are taken. \pre lists_labels
void draw_label_rows(PanelContext& context, const FormField& field);

}  // namespace vesselbench
