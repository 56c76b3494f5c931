#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kernel/topology.h"

namespace vesselbench {

/// True if a numbering of vertices follows the mesh, so that neighbours are close to each other in
/// memory: that of slices or fronts does, as that of iso-surfaces.
/// \param bandwidth largest distance between the numbers of two neighbours
[[nodiscard]] bool follows_mesh(std::size_t bandwidth, std::size_t vertex_count);

/// Breadth-first order of the vertices, each component from one of its ends: vertex at every place.
/// Source: Cuthill, McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969.
[[nodiscard]] std::vector<VertexId> order_along_mesh(const CompressedRows& neighbours);

/// The place of every vertex in an order.
[[nodiscard]] std::vector<VertexId> places_in(const std::vector<VertexId>& order);

/// The order of a surface's vertices that follows the mesh; empty: their own does.
[[nodiscard]] std::vector<VertexId> mesh_order(const Topology& topology);

}  // namespace vesselbench
