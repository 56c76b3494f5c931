#include "geometry/vessel/openings/wall_axis.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/unsmoothed.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_place.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 2.0, kLength = 40.0, kBend = 10.0;

/// On a circle from the origin, at first along z.
Vec3 line_at(double s) {
    return kBend * Vec3(1.0 - std::cos(s / kBend), 0.0, std::sin(s / kBend));
}

Vec3 forward_at(double s) {
    return {std::sin(s / kBend), 0.0, std::cos(s / kBend)};
}

/// A tube along the line, three triangles wide, whose vertices lie on the wall.
Surface coarse_bend(const Surface& tube) {
    return mapped(tube, [](const Vec3& p) {
        const Vec3 aside = Vec3::UnitY().cross(forward_at(p.z()));
        return Vec3(line_at(p.z()) + p.x() * aside + p.y() * Vec3::UnitY());
    });
}

Surface open_bend() {
    return coarse_bend(open_tube(kRadius, kLength, 9, 36));
}

/// Closed; its end at the origin is nearly half a sphere.
Surface rounded_bend() {
    const Surface tube = closed_tube(kRadius, kLength, 9, 36);
    return coarse_bend(
        mapped(make_surface(tube.points(), {tube.triangles().begin(), tube.triangles().end()}),
               [](const Vec3& p) {
                   const double beyond = std::clamp(1.0 - p.z() / kRadius, 0.0, 0.95);
                   const double share = std::sqrt(1.0 - beyond * beyond);
                   return Vec3(share * p.x(), share * p.y(), p.z());
               }));
}

/// Moved as smoothing moves the vertices of coarse triangles: by up to a share of the diameter, in
/// no order.
Surface moved(const Surface& surface, double share) {
    Positions points = surface.points();
    for (std::size_t v = 0; v < points.size(); ++v) {
        const auto n = static_cast<double>(v);
        points[v] += share * 2.0 * kRadius *
                     Vec3(std::sin(12.9 * n), std::sin(78.2 * n + 1.0), std::sin(37.7 * n + 2.0));
    }
    return surface.with_positions(std::move(points));
}

/// Moved as smoothing moves a vessel whose triangles differ along it.
Surface pulled_aside(const Surface& surface, double share) {
    return mapped(surface, [&](const Vec3& p) {
        const double s = kBend * std::atan2(p.z(), kBend - p.x());
        return Vec3(p + share * 2.0 * kRadius * std::sin(2.0 * s / kRadius) * Vec3::UnitY());
    });
}

CenterlineGraph graph_of_bend() {
    CenterlineBranch branch{.start_node = 0, .end_node = 1, .points = {}, .radii = {}};
    for (int i = 0; i <= 200; ++i) {
        branch.points.push_back(line_at(0.5 * kRadius + (kLength - kRadius) * i / 200));
        branch.radii.push_back(kRadius);
    }
    CenterlineGraph graph;
    graph.nodes = {{branch.points.front(), kRadius, {0}}, {branch.points.back(), kRadius, {0}}};
    graph.branches = {branch};
    return graph;
}

/// Of a cap at the line's beginning, by the direction within a quarter of a diameter.
double tilt_deg(const Plane& plane) {
    const double at = kBend * std::atan2(plane.point.z(), kBend - plane.point.x());
    double least = 180.0;
    for (double s = at - 0.5 * kRadius; s <= at + 0.5 * kRadius; s += 0.05 * kRadius)
        least = std::min(least, angle_deg(plane.normal, -forward_at(s)));
    return least;
}

}  // namespace

SCENARIO("A clean wall's vertices show a vessel's direction", "[geometry][openings][wall_axis]") {
    // 10 degrees off, and off the line
    const double s = 3.0 * kRadius;
    const Vec3 normal = (-forward_at(s) + 0.17 * Vec3::UnitY()).normalized();
    const Plane plane{line_at(s) + 0.1 * Vec3::UnitY(), normal};
    const Surface bend = open_bend();
    const double diameter = 2.0 * kRadius;
    GIVEN("a bend three triangles wide") {
        const auto axis = wall_axis(bend, plane, diameter, {-0.5, 2.0});
        REQUIRE(axis);
        CHECK(tilt_deg({plane.point, axis->direction}) < 0.5);
        CHECK(axis->bend_deg == Approx(diameter / kBend * 180.0 / 3.14159).margin(1.0));
        CHECK(axis->doubt_deg < 1.0);
    }
    GIVEN("a wall with noise: its sections show the direction better") {
        CHECK_FALSE(wall_axis(moved(bend, 0.02), plane, diameter, {-0.5, 2.0}));
    }
    GIVEN("a smoothed wall that knows where its vertices lay") {
        const Surface smoothed = with_unsmoothed(moved(bend, 0.02), bend.points());
        const auto axis = wall_axis(smoothed, plane, diameter, {-0.5, 2.0});
        REQUIRE(axis);
        CHECK(tilt_deg({plane.point, axis->direction}) < 0.5);
    }
    GIVEN("a vessel that ends right behind the plane") {
        CHECK_FALSE(wall_axis(bend, plane, diameter, {0.0, 0.1}));
    }
}

SCENARIO("A cap of a coarse smoothed surface is perpendicular", "[geometry][openings][wall_axis]") {
    const Surface bend = rounded_bend();
    const Surface smoothed = pulled_aside(bend, 0.03);
    const CenterlineGraph graph = graph_of_bend();
    const OpeningPlace by_sections = choose_opening_place(smoothed, graph, 0);
    const OpeningPlace place =
        choose_opening_place(with_unsmoothed(smoothed, bend.points()), graph, 0);
    CHECK(tilt_deg(by_sections.plane) > 2.0);
    CHECK(tilt_deg(place.plane) < 0.5);
    CHECK(place.doubt_deg < by_sections.doubt_deg);
    CHECK(place.tilt_deg == 0.0);
}

SCENARIO("The axis at a cap of a smoothed surface is that of its wall before",
         "[geometry][openings][wall_axis]") {
    const Surface tube = closed_tube(kRadius, kLength, 9, 36);
    const Surface smoothed = mapped(tube, [](const Vec3& p) {
        return Vec3(p + 0.12 * kRadius * std::sin(p.z() / kRadius) * Vec3::UnitY());
    });
    CHECK(opening_tilt_deg(smoothed, 1) > 2.0);
    CHECK(opening_tilt_deg(with_unsmoothed(smoothed, tube.points()), 1) < 0.1);
}

SCENARIO("The places before smoothing are those before the first one", "[geometry][wall_axis]") {
    const Surface tube = open_tube(1.0, 4.0, 8, 4);
    const Surface once = moved(tube, 0.01);
    CHECK(unsmoothed(once) == once.points());
    const Surface twice =
        with_unsmoothed(moved(with_unsmoothed(once, tube.points()), 0.01), once.points());
    CHECK(unsmoothed(twice) == tube.points());
    CHECK(twice.points() != tube.points());
}
