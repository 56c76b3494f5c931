#pragma once

#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// The plane of a sac's neck as a ring, and two handles: its place, which moves along its normal,
/// and its direction. A plane that the operation decides is shown faintly, a typed one not; nothing
/// while it is not known.
/// \pre the form has a field of Meaning::Neck
[[nodiscard]] FormShape neck_shape(const OperationForm& form);

/// The form's texts when a handle is dragged: either one fixes place and direction.
/// \param form as for neck_shape at the drag's start
/// \param handle 0 the place, 1 the direction
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> neck_texts(const OperationForm& form, std::size_t handle,
                                                const Vec3& to);

}  // namespace vesselbench
