#pragma once

#include <cstddef>
#include <optional>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/narrowing/narrowing.h"

namespace vesselbench {

/// How far a narrowing is widened.
struct NarrowingCorrection {
    double strength = 1.0;         ///< 1: to the expected radius, 0: not at all [-], in [0, 1]
    std::optional<double> radius;  ///< wanted at the deepest place at full strength [mm]; default:
                                   ///< the expected one. Elsewhere in proportion
    double blend = 1.0;  ///< on each side, over which the widening fades out [expected radii], > 0
};

/// A surface with one narrowing less.
struct CorrectedNarrowing {
    Surface surface;              ///< same connectivity; other vertices are moved by no bit
    std::size_t moved = 0;        ///< vertices
    double farthest = 0.0;        ///< that a vertex moved [mm]
    double from = 0.0, to = 0.0;  ///< with the blends: arc length of what moved [mm]
    double radius = 0.0;          ///< at the deepest place [mm]
};

/// Widens a narrowing: distances from the axis are multiplied by what is expected over what was
/// found, which varies along the axis but not around it, so that flattened and other sections keep
/// their shape. Beyond the stretch, the factor fades to 1.
/// Source: thesis 4.2.4.
/// \param rings of the narrowing's branch (wall_rings)
/// \throw InvalidInput if a parameter is out of range, or the radius is not larger than the one
///        found; Cancelled
/// \throw AlgorithmFailure, with its place, if there is no free vessel around the stretch, its wall
///        is no tube there, or so narrow that it would become more than 4 times as wide, or the
///        wider vessel would touch another wall
[[nodiscard]] CorrectedNarrowing correct_narrowing(const Surface& surface,
                                                   const CenterlineGraph& graph,
                                                   const std::vector<WallRing>& rings,
                                                   const Narrowing& narrowing,
                                                   const NarrowingCorrection& parameters = {},
                                                   const Progress& progress = {});

}  // namespace vesselbench
