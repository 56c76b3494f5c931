#pragma once

#include <optional>
#include <vector>

#include "geometry/editing/editable_surface.h"
#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// What a cut along one section curve leaves: nothing is removed yet.
struct PlaneCut {
    /// Closed loop along the plane, in the direction of the half-edges below it (clockwise seen
    /// from above); empty if the cut is not one simple loop.
    std::vector<VertexId> rim;
    std::vector<TriangleId> below, above;  ///< triangles at the rim, on each side of the plane
};

enum class NearVertices {
    Stay,
    MoveOntoPlane  ///< along their edges, so that no slivers arise
};

/// Divides the triangles that a section curve runs through, along the plane; other vessels that
/// the plane happens to meet stay whole.
/// \param curve a section of the surface by the plane, closed
[[nodiscard]] PlaneCut cut_along(EditableSurface& surface, const Plane& plane,
                                 const SectionCurve& curve, NearVertices near);

/// Everything that hangs together with the cut's upper triangles, 1 for each triangle number; none
/// if the lower ones do, too (a loop of vessels).
[[nodiscard]] std::optional<std::vector<std::uint8_t>> part_above(const EditableSurface& surface,
                                                                  const PlaneCut& cut);

/// Collapses short edges of an open planar rim, one at a time, where no triangle turns over.
/// \param rim loses the vertices that go
void clean_rim(EditableSurface& surface, std::vector<VertexId>& rim);

}  // namespace vesselbench
