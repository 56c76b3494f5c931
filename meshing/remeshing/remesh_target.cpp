#include "meshing/remeshing/remesh_target.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "geometry/kernel/parallel.h"
#include "meshing/remeshing/vertex_fields.h"

namespace vesselbench {

namespace {

/// A patch counts as flat if no vertex is farther from its plane than this fraction of its size
/// (square root of its area): clipped caps are flat to float precision, curved walls are not.
constexpr double kFlatness = 2e-3;

/// A rim counts as round if its vertices are this close to a circle, in radii, and no edge spans
/// more than 30 degrees: extruded and blended openings are round to float precision.
constexpr double kRoundness = 1e-3;
constexpr double kRoundestEdge = 0.53;  // edge length in radii, slightly above 2 sin(15 deg)

/// A walk that ends farther away than this many target lengths may have missed a closer place.
constexpr double kFarWalk = 0.3;

constexpr double kSlack = 1.0 + 1e-9;  // rounding must not exclude the hint itself

}  // namespace

RemeshTarget::RemeshTarget(const Surface& surface, std::span<const double> sizes)
    : surface_(surface), sizes_(sizes.begin(), sizes.end()), patches_(surface.patches.size()) {
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        patches_[(*surface.patch_labels)[t]].triangles.push_back(t);
    find_planes();
    flatten();
    normals_.resize(surface.triangle_count());
    for_each_vertex(normals_.size(), [&](std::size_t t) {
        normals_[t] = area_normal(surface_.points(), surface_.triangles()[t]).normalized();
    });
    walk_.emplace(surface_);
    for (PatchTarget& patch : patches_) {
        if (patch.triangles.empty()) continue;
        std::vector<Triangle> corners;
        for (const TriangleId t : patch.triangles) corners.push_back(triangle(t));
        patch.search = distance_to(surface_.points(), corners);
    }
    find_rims();
}

void RemeshTarget::find_planes() {
    for (std::size_t p = 0; p < patches_.size(); ++p)
        if (surface_.patches[p].kind != PatchKind::Wall && !patches_[p].triangles.empty())
            patches_[p].plane = fitted_plane(patches_[p]);
}

std::optional<RemeshTarget::Plane> RemeshTarget::fitted_plane(const PatchTarget& patch) const {
    const Positions& points = surface_.points();
    Vec3 normal = Vec3::Zero(), centroid = Vec3::Zero();
    double area = 0.0;
    for (const TriangleId t : patch.triangles) {
        const Vec3 n = area_normal(points, triangle(t));
        const double weight = n.norm();
        normal += n;
        area += weight;
        for (const VertexId v : triangle(t)) centroid += weight / 3.0 * points[v];
    }
    if (!(area > 0.0) || normal.norm() < 0.9 * area) return std::nullopt;
    const Plane plane{centroid / area, normal.normalized()};
    const double allowed = kFlatness * std::sqrt(0.5 * area);
    for (const TriangleId t : patch.triangles)
        for (const VertexId v : triangle(t))
            if (std::abs((points[v] - plane.origin).dot(plane.normal)) > allowed)
                return std::nullopt;
    return plane;
}

void RemeshTarget::flatten() {
    Positions flat = surface_.points();
    for (const PatchTarget& patch : patches_) {
        if (!patch.plane) continue;
        const auto& [origin, normal] = *patch.plane;
        for (const TriangleId t : patch.triangles)
            for (const VertexId v : triangle(t)) flat[v] -= (flat[v] - origin).dot(normal) * normal;
    }
    surface_ = surface_.with_positions(std::move(flat));
}

RemeshTarget::RimKey RemeshTarget::key(std::uint32_t p, std::uint32_t q) const {
    const auto beyond = static_cast<std::uint32_t>(patches_.size());
    return std::minmax(std::min(p, beyond), std::min(q, beyond));
}

void RemeshTarget::find_rims() {
    const auto hole = static_cast<std::uint32_t>(patches_.size());
    const CompressedRows& fans = surface_.topology->triangles_at();
    const auto triangles = surface_.triangles();
    for (TriangleId t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const VertexId a = triangles[t][i], b = triangles[t][(i + 1) % 3];
            std::uint32_t other = hole;
            for (const TriangleId s : fans.row(a))
                if (s != t && std::count(triangles[s].begin(), triangles[s].end(), b) > 0)
                    other = (*surface_.patch_labels)[s];
            const std::uint32_t own = (*surface_.patch_labels)[t];
            if (own < other) rims_[key(own, other)].segments.push_back({a, b, b});
        }
    for (auto& [patches, rim] : rims_) {
        rim.search.emplace(surface_.points(), rim.segments);
        for (const std::uint32_t p : {patches.first, patches.second})
            if (const auto normal = plane_normal(p); normal && !rim.circle)
                rim.circle = fitted_circle(rim, *normal);
    }
}

std::optional<RemeshTarget::Circle> RemeshTarget::fitted_circle(const RimTarget& rim,
                                                                const Vec3& axis) const {
    const Positions& points = surface_.points();
    const Vec3 origin = points[rim.segments.front()[0]], x = axis.unitOrthogonal(),
               y = axis.cross(x);
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Vec3 right = Vec3::Zero();
    for (const auto& segment : rim.segments) {  // least squares of |p|^2 = 2 p . centre + k
        const Vec3 p = points[segment[0]] - origin;
        const Vec3 row(2.0 * p.dot(x), 2.0 * p.dot(y), 1.0);
        normal_matrix += row * row.transpose();
        right += row * (std::pow(p.dot(x), 2) + std::pow(p.dot(y), 2));
    }
    const Vec3 solution = normal_matrix.ldlt().solve(right);
    if (!solution.allFinite()) return std::nullopt;
    Circle circle{origin + solution[0] * x + solution[1] * y, axis, 0.0};
    for (const auto& segment : rim.segments)
        circle.radius += (points[segment[0]] - circle.centre).norm() / rim.segments.size();
    for (const auto& segment : rim.segments) {
        const double off = (points[segment[0]] - circle.centre).norm() - circle.radius;
        const double edge = (points[segment[1]] - points[segment[0]]).norm();
        if (!(std::abs(off) <= kRoundness * circle.radius)) return std::nullopt;
        if (!(edge <= kRoundestEdge * circle.radius)) return std::nullopt;
    }
    return circle;
}

SurfaceWalk::Place RemeshTarget::closest_on(std::uint32_t patch, const Vec3& x,
                                            TriangleId near) const {
    const PatchTarget& target = patches_[patch];
    SurfaceWalk::Place walked;
    if (near < normals_.size() && (*surface_.patch_labels)[near] == patch) {
        walked = walk_->closest(x, near);
        const double far = kFarWalk * size_at(triangle(walked.triangle), walked.weights);
        if (walked.squared <= far * far) return walked;
    }
    const auto hit = target.search->closest_point(x, kSlack * std::sqrt(walked.squared));
    const TriangleId t = hit ? target.triangles[hit->triangle] : walked.triangle;
    return walk_->place_on(t, x);
}

SurfacePoint RemeshTarget::closest_on(const RimTarget& rim, const Vec3& x, TriangleId near) const {
    if (near >= rim.segments.size()) return rim.search->closest_point(x);
    const auto& [a, b, c] = rim.segments[near];
    const Positions& points = surface_.points();
    const Vec3 hint = closest_point_on_triangle(x, points[a], points[b], points[c]);
    const auto found = rim.search->closest_point(x, kSlack * (hint - x).norm());
    return found ? *found : rim.search->closest_point(x);
}

double RemeshTarget::size_at(const Triangle& triangle, const Vec3& weights) const {
    return weights[0] * sizes_[triangle[0]] + weights[1] * sizes_[triangle[1]] +
           weights[2] * sizes_[triangle[2]];
}

TargetPlace RemeshTarget::on_patch(std::uint32_t patch, const Vec3& x, TriangleId near) const {
    const SurfaceWalk::Place hit = closest_on(patch, x, near);
    TargetPlace place{hit.point, normals_[hit.triangle],
                      size_at(triangle(hit.triangle), hit.weights), hit.triangle};
    if (const auto& plane = patches_[patch].plane) {
        place.normal = plane->normal;
        place.point = x - (x - plane->origin).dot(place.normal) * place.normal;
    }
    return place;
}

TargetPlace RemeshTarget::on_rim(std::uint32_t p, std::uint32_t q, const Vec3& x,
                                 TriangleId near) const {
    const RimTarget& rim = rims_.at(key(p, q));
    const SurfacePoint hit = closest_on(rim, x, near);
    const Triangle& segment = rim.segments[hit.triangle];
    TargetPlace place{hit.point, Vec3::Zero(),
                      size_at(segment, barycentric(surface_.points(), segment, hit.point)),
                      hit.triangle};
    if (rim.circle) {
        const auto& [centre, axis, radius] = *rim.circle;
        const Vec3 outward = hit.point - centre;
        const Vec3 in_plane = outward - outward.dot(axis) * axis;
        place.point = centre + radius * in_plane.normalized();
    }
    return place;
}

std::optional<Vec3> RemeshTarget::plane_normal(std::uint32_t patch) const {
    if (patch >= patches_.size() || !patches_[patch].plane) return std::nullopt;
    return patches_[patch].plane->normal;
}

}  // namespace vesselbench
