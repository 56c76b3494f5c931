#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/repair/repair_parameters.h"
#include "geometry/vessel/repair/repair_report.h"

namespace vesselbench {

struct Repaired {
    Surface surface;
    RepairReport report;
};

/// Turns arbitrary triangles into an oriented 2-manifold with boundary: outward, without
/// self-intersections, degenerate triangles, stray pieces and stray holes; vessel ends stay open,
/// patches and attributes are carried over. A repaired surface is returned unchanged. A loop is a
/// vessel end if it is about as wide as the lumen behind it, or a flat, round cut. Non-manifold
/// places are split along the sheets that enclose the solid, as in Gueziec et al., "Cutting and
/// stitching: converting sets of polygons to manifold surfaces", 2001.
/// \throw InvalidInput if there is no triangle, or a coordinate is not finite
/// \throw AlgorithmFailure with count, place and remedy if the surface is not a body (scattered
/// triangles, a Moebius strip), or self-intersections remain
[[nodiscard]] Repaired repair(const Surface& surface, const RepairParameters& parameters = {},
                              const Progress& progress = {});

}  // namespace vesselbench
