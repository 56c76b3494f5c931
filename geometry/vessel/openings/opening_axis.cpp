#include "geometry/vessel/openings/opening_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Dense>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr double kFirstSection = 0.25;  // diameters inward
constexpr double kSectionStep = 0.125;
constexpr int kSections = 7;
constexpr double kLargestAreaRatio = 1.6;

Positions centroids_inward(const Surface& surface, const Plane& plane, double diameter) {
    Positions found;
    double area = std::numbers::pi * diameter * diameter / 4.0;
    Vec3 at = plane.point;
    double depth = 0.0;
    for (int k = 0; k < kSections; ++k) {
        const double next = (kFirstSection + k * kSectionStep) * diameter;
        at -= (next - depth) * plane.normal;
        depth = next;
        const auto curve = cross_section_at(surface, {at, plane.normal});
        if (!curve || !curve->closed) break;
        const double ratio = std::abs(curve->area) / area;
        if (ratio > kLargestAreaRatio || ratio < 1.0 / kLargestAreaRatio) break;
        area = std::abs(curve->area);
        at = curve->centroid;
        found.push_back(at);
    }
    return found;
}

/// Where the direction is taken [diameters inward].
constexpr double kDirectionAt = 0.2;

/// The line's direction at a depth, outward: slope of the quadratic through the points by their
/// depths [diameters]. Its curvature counts as far as it exceeds what the points' scatter explains.
Vec3 direction_at(const Positions& points, const std::vector<double>& depths, double at) {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd A(n, 3), b(n, 3);
    const double middle = 0.5 * (depths.front() + depths.back());
    for (Eigen::Index i = 0; i < n; ++i) {
        const double d = depths[static_cast<std::size_t>(i)] - middle;
        A.row(i) << 1.0, d, d * d;
        b.row(i) = points[static_cast<std::size_t>(i)].transpose();
    }
    const Eigen::Matrix3d normal = A.transpose() * A;
    const Eigen::Matrix3d fitted = normal.ldlt().solve(A.transpose() * b);
    const double scatter =
        n > 3 ? (A * fitted - b).squaredNorm() / static_cast<double>(n - 3) : 0.0;
    const double curvature = fitted.row(2).squaredNorm();
    const double doubt = scatter * normal.inverse()(2, 2);
    const double trust = curvature > 0.0 ? curvature / (curvature + doubt) : 0.0;
    const Vec3 slope = (fitted.row(1) + trust * 2.0 * (at - middle) * fitted.row(2)).transpose();
    return -slope.normalized();
}

/// Turn over one diameter: the angle between the chords of both halves, which are half the sampled
/// depth apart.
double bend(const Positions& centroids, double diameter) {
    const Vec3& first = centroids.front();
    const Vec3& last = centroids.back();
    const Vec3& middle = centroids[centroids.size() / 2];
    const double apart = 0.5 * (last - first).norm();
    return apart > 0.0 ? angle_deg(middle - first, last - middle) * diameter / apart : 0.0;
}

}  // namespace

double angle_deg(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

std::optional<OpeningAxis> axis_inward(const Surface& surface, const Plane& plane,
                                       double diameter) {
    const Positions centroids = centroids_inward(surface, plane, diameter);
    if (centroids.size() < 3) return std::nullopt;
    Positions line{plane.point};
    std::vector<double> depths{0.0};
    for (std::size_t k = 0; k < centroids.size(); ++k) {
        line.push_back(centroids[k]);
        depths.push_back(kFirstSection + static_cast<double>(k) * kSectionStep);
    }
    OpeningAxis axis{.direction = direction_at(line, depths, kDirectionAt),
                     .bend_deg = bend(centroids, diameter),
                     .diameter = diameter,
                     .sections = static_cast<int>(centroids.size())};
    axis.tilt_deg = angle_deg(axis.direction, plane.normal);
    return axis;
}

std::optional<OpeningAxis> axis_at_patch(const Surface& surface, std::size_t patch) {
    const PatchShape shape = patch_shape(surface, patch);
    return axis_inward(part_near(surface, shape.plane.point, 2.5 * shape.diameter()), shape.plane,
                       shape.diameter());
}

double opening_tilt_deg(const Surface& surface, std::size_t patch) {
    const auto axis = axis_at_patch(surface, patch);
    return axis ? axis->tilt_deg : 90.0;
}

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

Surface part_near(const Surface& surface, const Vec3& centre, double radius) {
    std::vector<bool> near, keep;
    for (const Vec3& p : surface.points())
        near.push_back((p - centre).squaredNorm() <= radius * radius);
    for (const auto& [a, b, c] : surface.triangles()) keep.push_back(near[a] || near[b] || near[c]);
    return select_triangles(surface, keep);
}

}  // namespace vesselbench
