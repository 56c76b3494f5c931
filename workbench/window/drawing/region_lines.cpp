#include "workbench/window/drawing/region_lines.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

namespace {

constexpr int kCirclePoints = 96;

}  // namespace

std::vector<RegionLine> box_lines(const Vec3& low, const Vec3& high) {
    const auto corner = [&](int i) {
        return Vec3((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                    (i & 4) != 0 ? high.z() : low.z());
    };
    std::vector<RegionLine> lines = {
        {.points = {corner(0), corner(1), corner(3), corner(2)}, .closed = true},
        {.points = {corner(4), corner(5), corner(7), corner(6)}, .closed = true}};
    for (int i = 0; i < 4; ++i) lines.push_back({.points = {corner(i), corner(i + 4)}});
    return lines;
}

std::vector<RegionLine> ball_lines(const Vec3& centre, double radius) {
    std::vector<RegionLine> lines;
    for (int axis = 0; axis < 3; ++axis)
        lines.push_back(circle_line(centre, Vec3::Unit(axis), radius));
    return lines;
}

Positions circle_points(const Vec3& centre, const Vec3& normal, double radius, int count) {
    Positions points;
    const auto [across, up] = plane_axes(normal);
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        points.emplace_back(centre + radius * (std::cos(angle) * across + std::sin(angle) * up));
    }
    return points;
}

RegionLine circle_line(const Vec3& centre, const Vec3& normal, double radius) {
    return {.points = circle_points(centre, normal, radius, kCirclePoints), .closed = true};
}

}  // namespace vesselbench
