#pragma once

#include <vector>

#include "gpu/render/drawing_arrays.h"

namespace vesselbench {

/// Fewer triangles of the same drawn vertices, for pictures that have to be fast: each vertex of an
/// independent set takes the place of its neighbours, which leaves about a fifth of the triangles.
/// Where patches meet, all vertices stay. Corners of one triangle may have the same colour, so that
/// edges cannot be drawn with them.
[[nodiscard]] std::vector<Triangle> coarse_triangles(const DrawingLayout& layout);

}  // namespace vesselbench
