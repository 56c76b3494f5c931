#pragma once

#include <string>

#include "workbench/window/case/stroke.h"
#include "workbench/window/case/stroke_request.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// The brush that a form describes by its fields.
/// \param otherwise for empty fields
[[nodiscard]] BrushTip tip_of(const OperationForm& form, const BrushTip& otherwise);

/// Writes a tip into the fields.
void set_tip(OperationForm& form, const BrushTip& tip);

/// \throw UsageError if a text of the form is wrong
[[nodiscard]] StrokeRequest stroke_of(const OperationForm& form, const BrushTip& tip,
                                      StrokeKeys keys);

/// Name of the vertex attribute that a form's brush paints; empty: it moves vertices.
[[nodiscard]] std::string painted_attribute(const OperationForm& form);

}  // namespace vesselbench
