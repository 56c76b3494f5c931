#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "smoothing/context/area_normals.h"
#include "smoothing/context/cap_parameters.h"

namespace vesselbench {

/// Connected flat vertices (whose triangles all lie along the vertex's normal) that have a plane
/// and may be enough for a cap; vertices outside a part's plane are dropped. One row per part, in
/// the order of the parts' first vertices.
[[nodiscard]] CompressedRows plane_parts(const AreaNormals& faces, const CapParameters& parameters);

/// cos of the largest spread of the face normals around a cap's mean normal.
[[nodiscard]] double spread_cosine();

/// Finds the planar flat areas among the triangles of the wall that are large enough to be caps,
/// each grown from a planar part up to the edges around it; no triangle is in two. The same for any
/// number of threads.
/// \return in the order of their first vertices
[[nodiscard]] std::vector<std::vector<TriangleId>> find_flat_areas(const AreaNormals& faces,
                                                                   const CompressedRows& parts,
                                                                   const CapParameters& parameters);

}  // namespace vesselbench
