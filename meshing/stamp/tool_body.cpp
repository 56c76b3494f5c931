#include "meshing/stamp/tool_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"

namespace vesselbench {

namespace {

constexpr int kAround = 24;       ///< edges around a capsule
constexpr int kBalls = 6;         ///< rings of its half balls
constexpr double kDetail = 0.35;  ///< of a radius: 18 edges around

Vec3 unit(const char* name, const Vec3& direction) {
    if (!direction.allFinite() || !(direction.norm() > 1e-9))
        throw InvalidInput(std::string(name) + " has no length");
    return direction.normalized();
}

/// A tube of rings with as many points each, closed by a fan at each end.
/// \param start,end tips beyond the first and the last ring
Surface closed_rings(const std::vector<Positions>& rings, const Vec3& start, const Vec3& end) {
    Positions points;
    std::vector<Triangle> triangles;
    const auto around = static_cast<VertexId>(rings.front().size());
    for (const Positions& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
    const auto first = static_cast<VertexId>(points.size()), last = first + 1;
    points.push_back(start);
    points.push_back(end);
    for (VertexId k = 0; k < around; ++k) {
        const VertexId next = (k + 1) % around;
        triangles.push_back({first, next, k});
        for (VertexId r = 0; r + 1 < rings.size(); ++r) {
            const VertexId low = r * around, high = low + around;
            triangles.push_back({low + k, low + next, high + next});
            triangles.push_back({low + k, high + next, high + k});
        }
        const auto top = static_cast<VertexId>((rings.size() - 1) * around);
        triangles.push_back({top + k, top + next, last});
    }
    return make_surface(std::move(points), std::move(triangles));
}

/// Points around an axis, counter-clockwise around it.
Positions ring(const Vec3& centre, const Vec3& x, const Vec3& y, double radius, std::size_t count) {
    Positions points;
    for (std::size_t k = 0; k < count; ++k) {
        const double angle =
            2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
        points.push_back(centre + radius * (std::cos(angle) * x + std::sin(angle) * y));
    }
    return points;
}

ToolBody body_of(Surface surface, double thickness, double detail) {
    ToolBody body{.surface = std::move(surface), .thickness = thickness, .detail = detail};
    const Bounds box = bounds(body.surface);
    body.centre = box.centre();
    for (const Vec3& p : body.surface.points())
        body.reach = std::max(body.reach, (p - body.centre).norm());
    return body;
}

/// Directions of the path's segments. \throw InvalidInput if one has no length or turns back
std::vector<Vec3> segment_directions(std::span<const Vec3> path) {
    constexpr double kTurnsBack = -0.9;  // cosine: the mitre would be four times as long as wide
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        directions.push_back(unit("a segment of the path", path[i + 1] - path[i]));
        if (i > 0 && directions[i].dot(directions[i - 1]) < kTurnsBack)
            throw InvalidInput("the path turns back on itself");
    }
    return directions;
}

}  // namespace

ToolBody box_body(const BoxTool& box) {
    require_positive("thickness", box.thickness);
    require_positive("length", box.length);
    require_positive("width", box.width);
    const Vec3 z = unit("direction", box.direction), given = unit("along", box.along);
    const Vec3 across = given - given.dot(z) * z;
    if (across.norm() < 1e-3) throw InvalidInput("along is parallel to direction");
    const Vec3 x = across.normalized(), y = z.cross(x);
    std::vector<Positions> rings;
    for (const double side : {-0.5, 0.5}) {
        const Vec3 middle = box.centre + side * box.thickness * z;
        const Vec3 half_x = 0.5 * box.length * x, half_y = 0.5 * box.width * y;
        rings.push_back({middle - half_x - half_y, middle + half_x - half_y,
                         middle + half_x + half_y, middle - half_x + half_y});
    }
    const Vec3 half = 0.5 * box.thickness * z;
    return body_of(closed_rings(rings, box.centre - half, box.centre + half),
                   std::min({box.thickness, box.length, box.width}),
                   std::max({box.thickness, box.length, box.width}));
}

ToolBody capsule_body(const CapsuleTool& capsule) {
    require_positive("radius", capsule.radius);
    require_range("length", capsule.length, 0.0, 1e6);
    const Vec3 z = unit("direction", capsule.direction);
    const auto [x, y] = plane_axes(z);
    std::vector<Positions> rings;
    for (const double side : {-1.0, 1.0})
        for (int i = 0; i < kBalls; ++i) {
            // From the tip to the segment's end, then from its other end to the other tip.
            const double turn = 0.5 * std::numbers::pi * (side < 0.0 ? i + 1 : i) / kBalls;
            const double rise = side < 0.0 ? -std::cos(turn) : std::sin(turn);
            const double wide = side < 0.0 ? std::sin(turn) : std::cos(turn);
            if (side > 0.0 && i == 0 && capsule.length == 0.0) continue;
            const Vec3 middle =
                capsule.centre + (0.5 * side * capsule.length + rise * capsule.radius) * z;
            rings.push_back(ring(middle, x, y, wide * capsule.radius, kAround));
        }
    const Vec3 tip = (0.5 * capsule.length + capsule.radius) * z;
    return body_of(closed_rings(rings, capsule.centre - tip, capsule.centre + tip),
                   2.0 * capsule.radius, kDetail * capsule.radius);
}

ToolBody swept_body(const SweptTool& swept) {
    require_positive("radius", swept.radius);
    require_range("sides", static_cast<double>(swept.sides), 3.0, 64.0);
    if (swept.path.size() < 2) throw InvalidInput("the path needs two points or more");
    const std::vector<Vec3> directions = segment_directions(swept.path);
    auto [x, y] = plane_axes(directions.front());
    std::vector<Positions> rings;
    Positions section = ring(swept.path[0], x, y, swept.radius, swept.sides);
    rings.push_back(section);
    for (std::size_t i = 1; i < swept.path.size(); ++i) {
        // Each corner's ring is the section slid along its segment into the plane of the mitre.
        const Vec3& before = directions[i - 1];
        const Vec3 normal =
            i + 1 < swept.path.size() ? Vec3((before + directions[i]).normalized()) : before;
        for (Vec3& p : section)
            p += ((swept.path[i] - p).dot(normal) / before.dot(normal)) * before;
        rings.push_back(section);
    }
    const auto mean_of = [](const Positions& points) {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& p : points) sum += p;
        return Vec3(sum / static_cast<double>(points.size()));
    };
    ToolBody body = body_of(closed_rings(rings, mean_of(rings.front()), mean_of(rings.back())),
                            2.0 * swept.radius, swept.radius);
    if (!self_intersections(body.surface.points(), body.surface.triangles()).empty())
        throw InvalidInput(
            "the path turns too tightly for the radius: the tool would cross itself");
    return body;
}

}  // namespace vesselbench
