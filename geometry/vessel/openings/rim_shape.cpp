#include "geometry/vessel/openings/rim_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/editing/hole_filling.h"
#include "geometry/kernel/edges.h"
#include "geometry/vessel/openings/profile.h"

namespace vesselbench {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// Fewer edges are those of a stray hole; less round ones those of a slit.
constexpr std::size_t kFewestEdges = 6;
constexpr double kLeastRoundness = 0.25;
/// A plane that grazes a vessel leaves a longer border than one across it, even at 55 degrees, and
/// a wall that leans more than that of a tapering vessel.
constexpr double kGrazedAspect = 1.75;
constexpr double kGrazedRiseDeg = 75.0;

/// Largest distance from the plane of a flat rim of this diameter [mm].
double flat_within(double diameter) {
    return 0.5 * diameter * std::tan(kFlatRimDeg / kDegrees);
}

/// The mean of |sine| between wall and plane normals, as the angle of the wall and the plane.
class MeanRise {
public:
    void add(const Vec3& wall, const Vec3& plane_normal, double length) {
        const double size = wall.norm();
        if (!(size > 0.0)) return;
        sum_ += length * std::abs(wall.dot(plane_normal)) / size;
        length_ += length;
    }

    [[nodiscard]] double degrees() const {
        return length_ > 0.0 ? std::acos(std::min(1.0, sum_ / length_)) * kDegrees : 0.0;
    }

private:
    double sum_ = 0.0, length_ = 0.0;
};

Vec3 loop_normal(const Positions& corners, const Vec3& centre) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += (corners[i] - centre).cross(corners[(i + 1) % corners.size()] - centre);
    // The wall's half-edges run clockwise seen from outside the vessel.
    return normal.norm() > 0.0 ? Vec3(-normal.normalized()) : Vec3(Vec3::UnitZ());
}

/// Length over width of a flat polygon, as of the ellipse with its second moments.
double aspect_of(const Positions& corners, const Vec3& centre, const Vec3& normal) {
    const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
    const auto at = [&](std::size_t i) {
        const Vec3 p = corners[i % corners.size()] - centre;
        return Eigen::Vector2d(p.dot(x), p.dot(y));
    };
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d p = at(i), q = at(i + 1);
        const double twice_area = p.x() * q.y() - p.y() * q.x();
        moments +=
            twice_area * (p * p.transpose() + q * q.transpose() + (p + q) * (p + q).transpose());
    }
    const double sum = std::abs(moments.trace());
    const double apart = std::sqrt(std::max(0.0, sum * sum - 4.0 * moments.determinant()));
    return sum > apart ? std::sqrt((sum + apart) / (sum - apart)) : 1.0;
}

double rise_of(const Surface& surface, std::span<const VertexId> loop, const Vec3& normal) {
    MeanRise rise;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
        const double length = (surface.points()[b] - surface.points()[a]).norm();
        for (const TriangleId t : surface.topology->triangles_at().row(a)) {
            const Triangle& corners = surface.triangles()[t];
            if (std::ranges::find(corners, b) != corners.end())
                rise.add(area_normal(surface.points(), corners), normal, length);
        }
    }
    return rise.degrees();
}

}  // namespace

double RimShape::diameter() const {
    return 2.0 * std::sqrt(area / std::numbers::pi);
}

double RimShape::roundness() const {
    return perimeter > 0.0 ? 4.0 * std::numbers::pi * area / (perimeter * perimeter) : 0.0;
}

bool RimShape::is_good() const {
    return edges >= kFewestEdges && roundness() > kLeastRoundness && rise_deg > kLeastRiseDeg &&
           flatness <= flat_within(diameter());
}

bool RimShape::is_graze() const {
    return aspect > kGrazedAspect && rise_deg < kGrazedRiseDeg;
}

RimShape rim_shape(const Surface& surface, std::span<const VertexId> loop) {
    Positions corners;
    for (const VertexId v : loop) corners.push_back(surface.points()[v]);
    const Vec3 centre = loop_centre(corners);
    RimShape shape{.plane = {centre, loop_normal(corners, centre)}, .edges = loop.size()};
    Positions flat;
    for (std::size_t i = corners.size(); i-- > 0;)
        flat.push_back(shape.plane.projected(corners[i]));
    const auto [area, centroid] = polygon_area(flat, shape.plane.normal);
    shape.area = std::abs(area);
    if (shape.area > 0.0) shape.plane.point = centroid;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        shape.perimeter += (corners[(i + 1) % corners.size()] - corners[i]).norm();
        shape.flatness = std::max(shape.flatness, std::abs(shape.plane.distance(corners[i])));
    }
    shape.rise_deg = rise_of(surface, loop, shape.plane.normal);
    shape.aspect = aspect_of(flat, shape.plane.point, shape.plane.normal);
    return shape;
}

std::optional<RimShape> rim_shape_of_cap(const Surface& surface, std::size_t patch) {
    const PatchShape cap = patch_shape(surface, patch);
    double reach = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if ((*surface.patch_labels)[t] == patch)
            for (const VertexId v : surface.triangles()[t])
                reach = std::max(reach, (surface.points()[v] - cap.plane.point).norm());
    const Surface near = part_near(surface, cap.plane.point, 1.5 * reach);
    std::vector<bool> wall;
    for (const std::uint16_t label : *near.patch_labels) wall.push_back(label != patch);
    const Surface open = select_triangles(near, wall);
    std::optional<RimShape> found;
    for (const auto& loop : open.topology->boundary_loops()) {
        RimShape shape = rim_shape(open, loop);
        const bool flat = std::ranges::all_of(loop, [&](VertexId v) {
            return std::abs(cap.plane.distance(open.points()[v])) <= cap.flatness + 1e-9 * reach &&
                   (open.points()[v] - cap.plane.point).norm() <= (1.0 + 1e-9) * reach;
        });
        if (!flat) continue;  // where the part was cut out
        if (found) return std::nullopt;
        found = std::move(shape);
    }
    return found;
}

bool is_flat(const PatchShape& shape) {
    return shape.flatness <= flat_within(shape.diameter());
}

double rise_deg(const Surface& surface, const SectionCurve& curve, const Plane& plane) {
    MeanRise rise;
    for (std::size_t i = 0; i < curve.triangles.size() && i < curve.points.size(); ++i) {
        const Vec3& next = curve.points[(i + 1) % curve.points.size()];
        rise.add(area_normal(surface.points(), surface.triangles()[curve.triangles[i]]),
                 plane.normal, (next - curve.points[i]).norm());
    }
    return rise.degrees();
}

}  // namespace vesselbench
