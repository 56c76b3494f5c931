#pragma once

#include <optional>
#include <vector>

#include "geometry/editing/editable_surface.h"
#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// Result of a cut along one section curve; nothing is removed yet.
struct PlaneCut {
    /// Closed loop along the plane, in the direction of the half-edges below it (clockwise seen
    /// from above); empty if the cut is not one simple loop.
    std::vector<VertexId> rim;
    std::vector<TriangleId> below, above;  ///< triangles at the rim, on each side of the plane
};

enum class NearVertices {
    Stay,
    MoveOntoPlane  ///< along their edges, to avoid slivers
};

/// Splits the triangles that a section curve crosses, along the plane; other vessels that cross the
/// plane stay whole.
/// \param curve a section of the surface by the plane, closed
[[nodiscard]] PlaneCut cut_along(EditableSurface& surface, const Plane& plane,
                                 const SectionCurve& curve, NearVertices near);

/// Everything connected to the triangles above the cut, 1 per triangle number; none if those below
/// are connected to it, too (a loop of vessels).
[[nodiscard]] std::optional<std::vector<std::uint8_t>> part_above(const EditableSurface& surface,
                                                                  const PlaneCut& cut);

/// Collapses short edges of an open planar rim, one at a time, unless a triangle would turn over.
/// \param rim loses the removed vertices
void clean_rim(EditableSurface& surface, std::vector<VertexId>& rim);

}  // namespace vesselbench
