#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/phantoms/field.h"

namespace vesselbench {

/// The zero set of a field inside `box` as a closed triangle surface, with every vertex moved onto
/// it by Newton steps along the gradient; outward. Open where the field leaves the box.
/// \param edge side of the sampling cells [mm]
/// \throw InvalidInput if they would be more than 256 Mi; Cancelled if the user cancels
[[nodiscard]] Surface exact_surface(const PhantomField& field, const Eigen::AlignedBox3d& box,
                                    double edge, const Progress& progress = {});

}  // namespace vesselbench
