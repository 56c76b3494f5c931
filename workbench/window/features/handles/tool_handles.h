#pragma once

#include "geometry/kernel/measure.h"
#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// True if the form places a tool's body in the model: a box, a capsule or a swept polygon.
[[nodiscard]] bool has_tool(const OperationForm& form);

/// The tool's body, and handles for its place, its direction and its sizes, or for the points of
/// its path; the last handle of a path adds a point. Empty as long as the tool is not known. A
/// polygon without a path gets a faint one in the middle of the model. \param model its box [mm]
[[nodiscard]] FormShape tool_shape(const OperationForm& form, const Bounds& model);

/// The form's texts when a handle is dragged.
/// \param form, model as for tool_shape at the drag's start
/// \param handle index into tool_shape's handles
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> tool_texts(const OperationForm& form, const Bounds& model,
                                                std::size_t handle, const Vec3& to);

}  // namespace vesselbench
