#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A vessel that a surface has no longer.
struct LostVessel {
    Vec3 place = Vec3::Zero();  ///< on its centerline, in the middle of what is missing [mm]
    double length = 0.0;        ///< of what is missing [mm]
    double diameter = 0.0;      ///< [mm]
};

/// The stretches of vessels, longer than 3 of their diameters, that are outside a later surface;
/// the widest vessel first. An end that was cut at its tip is shorter than that.
/// \param before centerlines of the surface before it was edited
[[nodiscard]] std::vector<LostVessel> lost_vessels(const CenterlineGraph& before,
                                                   const Surface& after);

/// The openings that lie in a vessel's side: the wall along their rims rises by less than 30
/// degrees from their planes, on average.
/// \param before openings that this surface has already do not count
/// \return patches of `after`
[[nodiscard]] std::vector<std::size_t> openings_in_walls(const Surface& before,
                                                         const Surface& after);

}  // namespace vesselbench
