#include "geometry/vessel/ends/patch_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/triangle_neighbours.h"

namespace vesselbench {

double PatchShape::diameter() const {
    return 2.0 * std::sqrt(area / std::numbers::pi);
}

PatchShape patch_shape(const Surface& surface, std::size_t patch) {
    Vec3 normal = Vec3::Zero(), moment = Vec3::Zero();
    PatchShape shape;
    const auto triangles = surface.triangles();
    const auto each = [&](const auto& use) {
        for (TriangleId t = 0; t < triangles.size(); ++t)
            if ((*surface.patch_labels)[t] == patch) use(triangles[t]);
    };
    each([&](const Triangle& t) {
        const Vec3 n = area_normal(surface.points(), t);
        const auto& x = surface.points();
        normal += n;
        shape.area += 0.5 * n.norm();
        moment += 0.5 * n.norm() * (x[t[0]] + x[t[1]] + x[t[2]]) / 3.0;
    });
    if (patch >= surface.patches.size() || !(shape.area > 0.0))
        throw InvalidInput("the surface has no patch number " + std::to_string(patch));
    shape.plane = {moment / shape.area, normal.normalized()};
    each([&](const Triangle& t) {
        for (const VertexId v : t)
            shape.flatness =
                std::max(shape.flatness, std::abs(shape.plane.distance(surface.points()[v])));
    });
    return shape;
}

double wall_rise_deg(const Surface& surface, std::size_t patch) {
    const Vec3 normal = patch_shape(surface, patch).plane.normal;
    const auto triangles = surface.triangles();
    const auto neighbours = edge_neighbours(triangles);
    double sum = 0.0, length = 0.0;
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        if ((*surface.patch_labels)[t] != patch) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const TriangleId beside = neighbours[t][k];
            if (beside == kNoTriangle || (*surface.patch_labels)[beside] == patch) continue;
            const Vec3 wall = area_normal(surface.points(), triangles[beside]);
            if (!(wall.norm() > 0.0)) continue;
            const double edge =
                (surface.points()[triangles[t][(k + 1) % 3]] - surface.points()[triangles[t][k]])
                    .norm();
            sum += edge * std::acos(std::clamp(wall.dot(normal) / wall.norm(), -1.0, 1.0));
            length += edge;
        }
    }
    return length > 0.0 ? sum / length * 180.0 / std::numbers::pi : 0.0;
}

Surface part_near(const Surface& surface, const Vec3& centre, double radius) {
    std::vector<bool> near, keep;
    for (const Vec3& p : surface.points())
        near.push_back((p - centre).squaredNorm() <= radius * radius);
    for (const auto& [a, b, c] : surface.triangles()) keep.push_back(near[a] || near[b] || near[c]);
    return select_triangles(surface, keep);
}

}  // namespace vesselbench
