#include "geometry/vessel/ends/patch_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// The rim of a cut may be rounded so far behind it; the wall is looked at from there to a radius
/// behind it, and not farther to the side [radii].
constexpr double kRounded = 0.5;
constexpr double kDeepest = 1.0;
constexpr double kFarthest = 3.0;

Vec3 middle_of(const Surface& surface, TriangleId t) {
    const auto& [a, b, c] = surface.triangles()[t];
    return (surface.points()[a] + surface.points()[b] + surface.points()[c]) / 3.0;
}

/// The triangles that lead from a patch's rim into the vessel behind it, ascending by their way.
/// \param radius of the patch [mm]
std::vector<TriangleId> wall_behind(const Surface& surface, std::size_t patch, const Plane& plane,
                                    double radius) {
    const auto& labels = *surface.patch_labels;
    const CompressedRows& at = surface.topology->triangles_at();
    std::vector<TriangleId> reached;
    std::unordered_set<TriangleId> seen;
    const auto reach_from = [&](TriangleId t) {
        for (const VertexId v : surface.triangles()[t])
            for (const TriangleId next : at.row(v)) {
                if (labels[next] == patch || !seen.insert(next).second) continue;
                const Vec3 from = middle_of(surface, next) - plane.point;
                const double depth = -from.dot(plane.normal);
                if (std::abs(depth) <= kDeepest * radius &&
                    (from + depth * plane.normal).norm() <= kFarthest * radius)
                    reached.push_back(next);
            }
    };
    for (TriangleId t = 0; t < labels.size(); ++t)
        if (labels[t] == patch) reach_from(t);
    for (std::size_t i = 0; i < reached.size(); ++i) reach_from(reached[i]);
    return reached;
}

}  // namespace

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
    const PatchShape shape = patch_shape(surface, patch);
    const double radius = 0.5 * shape.diameter();
    double sum = 0.0, weights = 0.0, near_sum = 0.0, near_weights = 0.0;
    for (const TriangleId t : wall_behind(surface, patch, shape.plane, radius)) {
        const Vec3 wall = area_normal(surface.points(), surface.triangles()[t]);
        const double area = wall.norm();
        if (!(area > 0.0)) continue;
        const double angle = std::acos(std::clamp(wall.dot(shape.plane.normal) / area, -1.0, 1.0));
        near_sum += area * angle;
        near_weights += area;
        if (-shape.plane.distance(middle_of(surface, t)) < kRounded * radius) continue;
        sum += area * angle;
        weights += area;
    }
    if (!(weights > 0.0)) std::tie(sum, weights) = std::pair(near_sum, near_weights);
    return weights > 0.0 ? sum / weights * 180.0 / std::numbers::pi : 90.0;
}

Surface part_near(const Surface& surface, const Vec3& centre, double radius) {
    std::vector<bool> near, keep;
    for (const Vec3& p : surface.points())
        near.push_back((p - centre).squaredNorm() <= radius * radius);
    for (const auto& [a, b, c] : surface.triangles()) keep.push_back(near[a] || near[b] || near[c]);
    return select_triangles(surface, keep);
}

}  // namespace vesselbench
