#pragma once

#include <vector>

#include "geometry/editing/editable_surface.h"
#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// A surface with one branch cut off; `rim` is the new border: a closed, planar loop in the
/// direction of the surface's half-edges (clockwise seen from the removed side).
struct OpenedSurface {
    EditableSurface surface;
    std::vector<VertexId> rim;
};

/// Cuts off everything beyond the curve in which the plane meets the vessel at the plane's point;
/// other vessels that cross the plane stay whole. Vertices near the plane are moved onto it along
/// their edges, and short rim edges are collapsed, to avoid slivers.
/// \param plane its normal points to the part to be removed
/// \throw AlgorithmFailure if there is no closed section at the plane's point, or if it does not
/// separate a part from the rest (a loop of vessels): the text names the point
[[nodiscard]] OpenedSurface cut_branch(const Surface& surface, const Plane& plane);

/// Closes a planar border loop with a flat cap as a separate patch; triangles of the rim's edge
/// length. Corners are projected onto the plane.
/// \param rim as from cut_branch
/// \throw AlgorithmFailure if the rim crosses itself
void cap_rim(OpenedSurface& opened, const Plane& plane, const Patch& patch);

/// Cuts, then caps.
[[nodiscard]] Surface clip_branch(const Surface& surface, const Plane& plane, const Patch& patch);

}  // namespace vesselbench
