#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "smoothing/context/caps.h"

namespace vesselbench {

/// Normal of a triangle.
struct FaceNormal {
    Vec3 weighted = Vec3::Zero();  ///< as long as twice the area [mm^2]

    /// Of it; 0: degenerate. Worked out again where it is needed, which memory notices less.
    [[nodiscard]] double length() const { return weighted.norm(); }
};

/// Normals of a surface's triangles. Keeps a reference to the surface.
class AreaNormals {
public:
    enum class When {
        Ahead,  ///< all are worked out now
        Asked   ///< each when it is asked for: where few are
    };

    AreaNormals(const Surface& surface, When when);

    [[nodiscard]] FaceNormal operator[](TriangleId t) const {
        return known_.empty() ? normal_of(t) : known_[t];
    }

private:
    [[nodiscard]] FaceNormal normal_of(TriangleId t) const;

    const Surface& surface_;
    std::vector<FaceNormal> known_;
};

/// Unit mean of the normals of some triangles, by area.
[[nodiscard]] Vec3 mean_normal(const AreaNormals& faces, std::span<const TriangleId> triangles);

/// Connected flat vertices (all of whose triangles lie along the vertex' normal) that have a plane
/// and may be enough for a cap; what lies outside of a part's plane is left out. A row a part, in
/// the order of the parts' first vertices.
[[nodiscard]] CompressedRows plane_parts(const Surface& surface, const AreaNormals& faces,
                                         const CapParameters& parameters);

/// cos of the largest spread of the face normals around a cap's own.
[[nodiscard]] double spread_cosine();

/// Per triangle the number of the flat area it belongs to; 0: none.
using AreaNumbers = std::vector<std::uint32_t>;

/// Flat areas of a surface that are large enough to be caps.
struct FlatAreas {
    AreaNumbers numbers;                         ///< #T; smaller areas have numbers, too
    std::vector<std::vector<TriangleId>> areas;  ///< in the order of their first vertices
};

/// Finds the plane flat areas among the triangles of the wall, each grown from a plane part up to
/// the edges around it; no triangle is in two. The same on any number of threads.
[[nodiscard]] FlatAreas find_flat_areas(const Surface& surface, const AreaNormals& faces,
                                        const CompressedRows& parts,
                                        const CapParameters& parameters);

}  // namespace vesselbench
