#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// What counts as a vertex' distance from the triangles around its reference vertex.
enum class LocalErrorForm : std::uint8_t {
    ClosestPoint,  ///< distance to their closest point
    Thesis,        ///< `local-error-thesis`, Eq. 6.2 as printed: largest distance to their planes
};

/// How far a smoothed surface is from its original.
struct LocalError {
    std::vector<double> values;  ///< per vertex [mm], #V, >= 0
    double mean = 0.0;           ///< over the vertices [mm]
    double largest = 0.0;        ///< [mm]
};

/// Every vertex as its own reference: where smoothing starts.
[[nodiscard]] std::vector<VertexId> own_references(const Topology& topology);

/// Moves each reference along the original's edges to the neighbour closest to the moved vertex,
/// until none is closer: the reference neighbourhood drifts with its vertex, but does not leap to
/// another branch that comes near. In parallel; time linear in the vertices and in the edges
/// that the drifts cross.
/// \param references an original vertex for each vertex; moved on
/// \throw InvalidInput unless original, moved and references are #V long and in range
void follow_drift(const Topology& topology, const Positions& original, const Positions& moved,
                  std::vector<VertexId>& references);

/// Distance of each moved vertex from the triangles of the original around its reference vertex.
/// Where the closest point of these lies on their outer edge and the triangles beyond are closer,
/// those count (slivers hide the surface from the vertex-to-vertex drift). So it is nothing for a
/// vertex that slid along the surface, and close to the distance from the whole original (never
/// below it) while the surface moved by less than its features. The same bits on any number of
/// threads.
/// A vertex whose reference has no triangle (of some area, in the thesis' form) gets the distance
/// from the reference itself; one whose place is not a number gets 0.
/// Source: Moench, thesis 6.4.1, Eqs. 6.1-6.2.
/// \param references from follow_drift
/// \throw InvalidInput unless original, moved and references are #V long and in range
[[nodiscard]] LocalError local_error(const Topology& topology, const Positions& original,
                                     const Positions& moved,
                                     const std::vector<VertexId>& references,
                                     LocalErrorForm form = LocalErrorForm::ClosestPoint);

/// One vertex' reference after a drift to `p`, as follow_drift moves it; nothing is checked.
[[nodiscard]] VertexId drifted_reference(const Topology& topology, const Positions& original,
                                         const Vec3& p, VertexId reference);

/// One vertex' local error at `p` [mm], as local_error gives it; nothing is checked.
[[nodiscard]] double local_error_at(const Topology& topology, const Positions& original,
                                    const Vec3& p, VertexId reference,
                                    LocalErrorForm form = LocalErrorForm::ClosestPoint);

/// The same, with the references followed from the vertices themselves to the moved positions.
[[nodiscard]] LocalError local_error(const Topology& topology, const Positions& original,
                                     const Positions& moved,
                                     LocalErrorForm form = LocalErrorForm::ClosestPoint);

}  // namespace vesselbench
