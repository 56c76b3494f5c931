#pragma once

#include <span>

#include "geometry/kernel/content_key.h"
#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Key of positions and triangles. A shared array is hashed once (DerivedCache::key_of).
/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] ContentKey shape_key(const Surface& surface, DerivedCache& cache = derived_cache());

/// Key of positions, triangles, patch labels and the patch table.
/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] ContentKey surface_key(const Surface& surface, DerivedCache& cache = derived_cache());

/// Key of positions and triangles, hashed on every call; equal to that of a surface with the same
/// arrays.
[[nodiscard]] ContentKey shape_key(const Topology& topology, const Positions& positions);
[[nodiscard]] ContentKey shape_key(const Positions& positions, std::span<const Triangle> triangles);

}  // namespace vesselbench
