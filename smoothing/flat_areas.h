#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface.h"
#include "smoothing/caps.h"

namespace vesselbench::detail {

/// Normal of a triangle.
struct FaceNormal {
    Vec3 weighted = Vec3::Zero();  ///< as long as twice the area [mm^2]

    /// Of it; 0: degenerate. Worked out again where it is needed, which memory notices less.
    [[nodiscard]] double length() const { return weighted.norm(); }
};

[[nodiscard]] std::vector<FaceNormal> face_normals(const Surface& surface);

/// Unit mean of the normals of some triangles, by area.
[[nodiscard]] Vec3 mean_normal(std::span<const FaceNormal> faces,
                               std::span<const TriangleId> triangles);

/// Per triangle the number of the flat area it belongs to; 0: none.
using AreaNumbers = std::vector<std::uint32_t>;

/// Flat areas of a surface that are large enough to be caps.
struct FlatAreas {
    AreaNumbers numbers;                         ///< #T; smaller areas have numbers, too
    std::vector<std::vector<TriangleId>> areas;  ///< in the order of their first vertices
};

/// Finds the plane flat areas among the triangles of the wall, each grown up to the edges around
/// it; no triangle is in two. The same on any number of threads.
[[nodiscard]] FlatAreas find_flat_areas(const Surface& surface, std::span<const FaceNormal> faces,
                                        const CapParameters& parameters);

}  // namespace vesselbench::detail
