#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "smoothing/context/caps.h"

namespace vesselbench {

/// Normal of a triangle.
struct FaceNormal {
    Vec3 weighted = Vec3::Zero();  ///< its length is twice the area [mm^2]

    /// Unit normal; 0: degenerate. Recomputed on demand, which costs less memory bandwidth.
    [[nodiscard]] double length() const { return weighted.norm(); }
};

/// Normals of a surface's triangles. Keeps a reference to the surface.
class AreaNormals {
public:
    enum class When {
        Ahead,  ///< all are computed now
        Asked   ///< each is computed when requested: if few are
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

/// Unit mean of the normals of some triangles, weighted by area.
[[nodiscard]] Vec3 mean_normal(const AreaNormals& faces, std::span<const TriangleId> triangles);

/// Connected flat vertices (whose triangles all lie along the vertex's normal) that have a plane
/// and may be enough for a cap; vertices outside a part's plane are dropped. One row per part, in
/// the order of the parts' first vertices.
[[nodiscard]] CompressedRows plane_parts(const Surface& surface, const AreaNormals& faces,
                                         const CapParameters& parameters);

/// cos of the largest spread of the face normals around a cap's mean normal.
[[nodiscard]] double spread_cosine();

/// Per triangle the number of the flat area it belongs to; 0: none.
using AreaNumbers = std::vector<std::uint32_t>;

/// Flat areas of a surface that are large enough to be caps.
struct FlatAreas {
    AreaNumbers numbers;                         ///< #T; smaller areas have numbers, too
    std::vector<std::vector<TriangleId>> areas;  ///< in the order of their first vertices
};

/// Finds the planar flat areas among the triangles of the wall, each grown from a planar part up to
/// the edges around it; no triangle is in two. The same for any number of threads.
[[nodiscard]] FlatAreas find_flat_areas(const Surface& surface, const AreaNormals& faces,
                                        const CompressedRows& parts,
                                        const CapParameters& parameters);

}  // namespace vesselbench
