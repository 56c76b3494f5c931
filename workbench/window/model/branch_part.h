#pragma once

#include <memory>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The margin of remove-branch when none is given [-].
inline constexpr double kUsualMargin = 0.4;

/// The centerlines of a surface with a line to a place: those of all vessel ends, and if none of
/// them is within `reach` radii, those to the place, such as a dome or a stub.
/// \throw what centerlines_of throws
[[nodiscard]] std::shared_ptr<const CenterlineGraph> lines_to(const Surface& surface,
                                                              const Vec3& tip, double reach,
                                                              const Progress& progress);

/// What remove-branch would cut off, as a surface; empty if it would fail.
/// \param margin as the operation's [-] \throw Cancelled
[[nodiscard]] Surface branch_part(const Surface& surface, const Vec3& tip, double margin,
                                  const Progress& progress);

}  // namespace vesselbench
