#pragma once

#include "geometry/kernel/measure.h"
#include "workbench/window/model/form_shape.h"

namespace vesselbench {

/// The region with its handles. Of a box: the middles of its faces (x, y, z of the low corner, then
/// of the high one), then its corners; of a ball: its centre, then six places on it. Where nothing
/// is given yet, a faint box around the model is offered, or the missing part of a ball.
/// \param model bounds of the model [mm]
[[nodiscard]] FormShape crop_shape(const OperationForm& form, const Bounds& model);

/// The form's texts when a handle is dragged.
/// \param form, model as for crop_shape at the drag's start
/// \param handle index into crop_shape's handles
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> crop_texts(const OperationForm& form, const Bounds& model,
                                                std::size_t handle, const Vec3& to);

}  // namespace vesselbench
