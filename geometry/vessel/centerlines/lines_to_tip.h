#pragma once

#include <memory>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The centerlines of all vessel ends; if none of their tips is within `reach` of its own radii
/// (tip_radius) of a point, those to the point: the automatic search leaves out stubs, sacs and
/// domes.
/// \param point near a tip [mm]
/// \param reach largest distance between the point and a tip that it means [radii of the tip]
/// \throw what centerlines_of throws
[[nodiscard]] std::shared_ptr<const CenterlineGraph> lines_to_tip(const Surface& surface,
                                                                  const Vec3& point, double reach,
                                                                  const Progress& progress = {});

}  // namespace vesselbench
