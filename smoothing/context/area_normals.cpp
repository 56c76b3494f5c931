#include "smoothing/context/area_normals.h"

#include "geometry/kernel/parallel.h"

namespace vesselbench {

AreaNormals::AreaNormals(const Surface& surface, When when) : surface_(surface) {
    if (when == When::Asked) return;
    LargeArray<FaceNormal> all(surface.triangle_count());
    const auto triangles = surface.triangles();
    const Positions& positions = surface.points();
    for_each_vertex(all.size(),
                    [&](std::size_t t) { all[t] = face_normal(positions, triangles[t]); });
    known_ = std::move(all);
}

Vec3 mean_normal(const AreaNormals& faces, std::span<const TriangleId> triangles) {
    Vec3 sum = Vec3::Zero();
    for (const TriangleId t : triangles) sum += faces[t].weighted();
    return sum.normalized();
}

}  // namespace vesselbench
