#pragma once

#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// True if the form's operation has points `from` and `to`: the ends of a stretch of a vessel.
[[nodiscard]] bool has_stretch(const OperationForm& form);

/// The stretch with its radius as rings, and three handles: its ends, which move along it, and its
/// radius. Values that the operation decides are shown faintly, typed ones not; nothing while an
/// end or the radius is not known.
/// \pre has_stretch
[[nodiscard]] FormShape stretch_shape(const OperationForm& form);

/// The form's texts when a handle is dragged: an end also fixes the other one.
/// \param form as for stretch_shape at the drag's start
/// \param handle 0 from, 1 to, 2 the radius
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> stretch_texts(const OperationForm& form, std::size_t handle,
                                                   const Vec3& to);

}  // namespace vesselbench
