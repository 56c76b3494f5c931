#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A surface whose patches are split along sharp edges, so that what keeps the rims of patches
/// keeps these edges, too (thesis 4.2.9: feature angle and feature size).
struct FeatureRegions {
    Surface surface;                      ///< the same triangles with more patches
    std::vector<Patch> patches;           ///< the original ones
    std::vector<std::uint16_t> patch_of;  ///< original patch of each patch of `surface`
    std::size_t edges = 0;                ///< feature edges kept

    /// Another surface with patches like `surface`, with the original ones.
    [[nodiscard]] Surface restored(const Surface& remeshed) const;
};

/// Regions that are bounded by edges which bend by more than the angle. One with less than the area
/// joins the neighbour with which it shares the longest border; an edge with the same region on
/// both sides is not kept.
/// \param angle_deg bend of an edge: 0 is flat, 90 a cube's edge; above 0, at most 180
/// \param least_area of a region [mm^2], >= 0
/// \throw InvalidInput if a parameter is out of range; AlgorithmFailure for more than 60000 regions
[[nodiscard]] FeatureRegions split_at_features(const Surface& surface, double angle_deg,
                                               double least_area);

}  // namespace vesselbench
