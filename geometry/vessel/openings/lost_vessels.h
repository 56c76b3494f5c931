#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A vessel that a surface has no longer: the longest way in what is missing, across furcations.
struct LostVessel {
    Vec3 place = Vec3::Zero();  ///< on its centerline, in the middle of its longest stretch [mm]
    double length = 0.0;        ///< of the way [mm]
    double diameter = 0.0;      ///< mean along the way [mm]
    Vec3 root = Vec3::Zero();   ///< where the way begins, next to what is left [mm]
    Vec3 tip = Vec3::Zero();    ///< where it ends [mm]
    double share =
        0.0;  ///< of the flow: the cube of its diameter over that of the widest vessel [-]

    /// So much of the flow is lost with it that the model is another one (kLeastShare).
    [[nodiscard]] bool matters() const;
};

/// A surface before and after an edit that takes a part away, as its caller says.
struct Removal {
    Surface before, after;
};

/// What a later surface misses of its vessels over more than 3 diameters, the widest first. Missing
/// stretches that meet at a furcation are one part, and each is measured in its own diameters. An
/// end that was cut at its tip is shorter than that.
/// \param before centerlines of the surface before it was edited
/// \param asked what these have taken away is not missed
[[nodiscard]] std::vector<LostVessel> lost_vessels(const CenterlineGraph& before,
                                                   const Surface& after,
                                                   std::span<const Removal> asked = {});

/// The openings that lie in a vessel's side: the wall along their rims rises by less than 30
/// degrees from their planes, on average.
/// \param before openings that this surface has already do not count
/// \return patches of `after`
[[nodiscard]] std::vector<std::size_t> openings_in_walls(const Surface& before,
                                                         const Surface& after);

}  // namespace vesselbench
