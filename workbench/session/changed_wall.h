#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface.h"
#include "workbench/case/stated_change.h"

namespace vesselbench {

/// What differs between two surfaces. Vertices and triangles are compared by the bits of their
/// places, so that it does not matter how they are numbered.

/// True if vertices may have moved, but triangles have the same corners.
[[nodiscard]] bool same_triangles(const Surface& a, const Surface& b);

/// True for a place in none of the zones.
[[nodiscard]] bool is_outside(const Vec3& place, std::span<const ChangeZone> zones);

/// A place outside the zones where one surface has a vertex and the other has none, or where its
/// triangles differ; none: both are the same there.
[[nodiscard]] std::optional<Vec3> change_outside(const Surface& before, const Surface& after,
                                                 std::span<const ChangeZone> zones);

/// 1 at the triangles that the other surface lacks, #T.
/// \param zones outside of which the surfaces are the same; none: anywhere
[[nodiscard]] std::vector<std::uint8_t> triangles_missing_in(
    const Surface& other, const Surface& surface,
    const std::optional<std::vector<ChangeZone>>& zones);

/// Middle of the triangle, of those that the other surface lacks, that lies farthest from it: a
/// part that is gone, a hole that is closed. None: both have the same triangles, or one has none.
[[nodiscard]] std::optional<Vec3> farthest_change(const Surface& before, const Surface& after);

/// Vertices of the flagged triangles, each once.
[[nodiscard]] std::vector<VertexId> corners_of(const Surface& surface,
                                               const std::vector<std::uint8_t>& flagged);

/// True if a triangle's box meets another one.
[[nodiscard]] bool meets(const Surface& surface, TriangleId t, const Bounds& box);

}  // namespace vesselbench
