#pragma once

#include "geometry/kernel/measure.h"
#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// The openings that the form names, else all inlets and outlets.
[[nodiscard]] std::vector<PatchMeasures> lengthened_openings(
    const OperationForm& form, const std::vector<PatchMeasures>& openings);

/// Where the caps go: a tube from each opening, with a handle at its end. Empty if the lengths are
/// those of an earlier run.
/// \param openings of the surface
[[nodiscard]] FormShape length_shape(const OperationForm& form,
                                     const std::vector<PatchMeasures>& openings);

/// The form's texts when a cap is dragged along its normal: a length, or a number of diameters if
/// it is near a whole one.
/// \param handle index into length_shape's handles
/// \param to where the handle is now [mm]
/// \param snap a length so near to a whole number of diameters becomes it [mm]
[[nodiscard]] std::vector<FieldText> length_texts(const OperationForm& form,
                                                  const std::vector<PatchMeasures>& openings,
                                                  std::size_t handle, const Vec3& to, double snap);

}  // namespace vesselbench
