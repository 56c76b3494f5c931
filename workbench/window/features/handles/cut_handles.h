#pragma once

#include "geometry/vessel/openings/planned_cut.h"
#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// Where the form cuts; none if it names no tip, or planes of several vessels.
[[nodiscard]] std::optional<CutQuestion> cut_question(const OperationForm& form);

/// The centerline, the cut as a ring with its figures, and two handles: one slides the plane along
/// the centerline, the other one tilts it.
[[nodiscard]] FormShape cut_shape(const OperationForm& form, const Cut& cut);

/// The form's texts when a handle is dragged. A plane that slides stays perpendicular to the
/// centerline: a distance from the tip; one that is tilted is given as it is (`planes`, `names`),
/// keeps its tilt when it slides, and is perpendicular again when it is hardly tilted.
/// \param form, cut as for cut_shape at the drag's start
/// \param handle 0 slides, 1 tilts
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> cut_texts(const OperationForm& form, const Cut& cut,
                                               std::size_t handle, const Vec3& to);

}  // namespace vesselbench
