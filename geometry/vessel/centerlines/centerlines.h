#pragma once

#include <memory>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/centerline_parameters.h"

namespace vesselbench {

/// The vessel tree inside a surface: one tip per boundary loop (at the loop's
/// centroid), per flat inlet/outlet/cut patch (at its centroid; in a closed surface
/// without labels also per flat disc that closes a vessel) and per blind end;
/// furcations where lines meet; loops where the lumen has handles. Every component that
/// encloses at least 1 % of the largest one's volume gets lines. Boundary loops that
/// are much smaller than the lumen there (a stray hole in a wall) are not ends.
///
/// Topology: distance-ordered homotopic thinning of the voxelised lumen between the
/// ends (Pudney, "Distance-ordered homotopic thinning", CVIU 72, 1998), so every loop
/// is a loop of the lumen. Vessels thinner than the grid's voxels are followed along their wall
/// (thin_vessels.h). Position and radius: the largest circle inscribed in the
/// wall within a slab around the perpendicular section, iterated; noise is averaged
/// over sectors of that slab. In a furcation the true distance to the wall limits the
/// radius. Near an end the closure (missing, or flat) is ignored, so radii do not
/// shrink towards an opening. Lines that pass straight through a furcation are smooth
/// there; blind ends extend as far as the section keeps half of the vessel's radius.
/// Deterministic for any number of threads. Works on open, closed, inside-out and
/// mildly defective surfaces.
/// \throw InvalidInput if the surface is empty, not finite, or encloses no lumen, if a
/// parameter is out of range, or if one of `ends` is not near the lumen
/// \throw AlgorithmFailure if no line can be found; the text says what to try
/// \throw Cancelled
[[nodiscard]] CenterlineGraph compute_centerlines(const Surface& surface,
                                                  const CenterlineParameters& parameters = {},
                                                  const Progress& progress = {});

/// The same, computed once for each surface and parameters (derived_cache.h).
/// \throw what compute_centerlines throws, each time
[[nodiscard]] std::shared_ptr<const CenterlineGraph> centerlines_of(
    const Surface& surface, const CenterlineParameters& parameters = {},
    const Progress& progress = {}, DerivedCache& cache = derived_cache());

}  // namespace vesselbench
