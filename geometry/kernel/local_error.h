#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Definition of a vertex's distance from the triangles around its reference vertex.
enum class LocalErrorForm : std::uint8_t {
    ClosestPoint,  ///< distance to their closest point
    Thesis,        ///< `local-error-thesis`, Eq. 6.2 as printed: largest distance to their planes
};

/// Distance of a smoothed surface from its original.
struct LocalError {
    std::vector<double> values;  ///< per vertex [mm], #V, >= 0
    double mean = 0.0;           ///< over the vertices [mm]
    double largest = 0.0;        ///< [mm]
};

/// Every vertex as its own reference: the start of smoothing.
[[nodiscard]] std::vector<VertexId> own_references(const Topology& topology);

/// Moves each reference along the original's edges to the neighbour closest to the moved vertex,
/// until none is closer: the reference neighbourhood drifts with its vertex, but does not jump to
/// another branch nearby. In parallel; time linear in the vertices and in the edges crossed by the
/// drifts.
/// \param references an original vertex for each vertex; updated
/// \throw InvalidInput unless original, moved and references are #V long and in range
void follow_drift(const Topology& topology, const Positions& original, const Positions& moved,
                  std::vector<VertexId>& references);

/// Distance of each moved vertex from the triangles of the original around its reference vertex.
/// If their closest point is on their outer edge and the triangles beyond are closer, those count
/// instead (slivers hide the surface from the vertex-to-vertex drift). The error is therefore
/// zero for a vertex that slid along the surface, and close to the distance from the whole
/// original (never below it) while the surface moved by less than its features. Bit-identical for
/// any number of threads. A vertex whose reference has no triangle (of non-zero area, in the
/// thesis's form) gets the distance from the reference itself; a vertex at a non-finite position
/// gets 0.
/// Source: Moench, thesis 6.4.1, Eqs. 6.1-6.2.
/// \param references from follow_drift
/// \throw InvalidInput unless original, moved and references are #V long and in range
[[nodiscard]] LocalError local_error(const Topology& topology, const Positions& original,
                                     const Positions& moved,
                                     const std::vector<VertexId>& references,
                                     LocalErrorForm form = LocalErrorForm::ClosestPoint);

/// One vertex's reference after a drift to `p`, as in follow_drift; unchecked.
[[nodiscard]] VertexId drifted_reference(const Topology& topology, const Positions& original,
                                         const Vec3& p, VertexId reference);

/// One vertex's local error at `p` [mm], as in local_error; unchecked.
[[nodiscard]] double local_error_at(const Topology& topology, const Positions& original,
                                    const Vec3& p, VertexId reference,
                                    LocalErrorForm form = LocalErrorForm::ClosestPoint);

/// The same, with references followed from the vertices themselves to the moved positions.
[[nodiscard]] LocalError local_error(const Topology& topology, const Positions& original,
                                     const Positions& moved,
                                     LocalErrorForm form = LocalErrorForm::ClosestPoint);

}  // namespace vesselbench
