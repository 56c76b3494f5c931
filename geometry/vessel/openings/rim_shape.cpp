#include "geometry/vessel/openings/rim_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/editing/hole_filling.h"
#include "geometry/vessel/openings/profile.h"

namespace vesselbench {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// Fewer edges are those of a stray hole; less round ones those of a slit.
constexpr std::size_t kFewestEdges = 6;
constexpr double kLeastRoundness = 0.25;

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
    return shape;
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
