#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "geometry/kernel/large_array.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Normal of a triangle; all 0 if the triangle is degenerate or has no finite normal.
struct FaceNormal {
    double x = 0.0, y = 0.0, z = 0.0;  ///< twice the area long [mm^2]
    double length = 0.0;               ///< of the normal [mm^2]

    [[nodiscard]] Vec3 weighted() const { return {x, y, z}; }
};

[[nodiscard]] inline FaceNormal face_normal(const Positions& positions, const Triangle& triangle) {
    const Vec3& a = positions[triangle[0]];
    const Vec3 normal = (positions[triangle[1]] - a).cross(positions[triangle[2]] - a);
    const double length = normal.norm();
    const bool valid = length > 0.0 && length <= std::numeric_limits<double>::max();
    return valid ? FaceNormal{normal.x(), normal.y(), normal.z(), length} : FaceNormal{};
}

/// Normals of a surface's triangles, shared by everything that is detected from them. Keeps a
/// reference to the surface.
class AreaNormals {
public:
    enum class When {
        Ahead,  ///< all are computed now
        Asked   ///< each is computed when requested: if few are
    };

    AreaNormals(const Surface& surface, When when);

    [[nodiscard]] FaceNormal operator[](TriangleId t) const {
        return known_.size() == 0 ? face_normal(surface_.points(), surface_.triangles()[t])
                                  : known_[t];
    }

    [[nodiscard]] const Surface& surface() const { return surface_; }

private:
    const Surface& surface_;
    LargeArray<FaceNormal> known_;
};

/// Unit mean of the normals of some triangles, weighted by area.
[[nodiscard]] Vec3 mean_normal(const AreaNormals& faces, std::span<const TriangleId> triangles);

}  // namespace vesselbench
