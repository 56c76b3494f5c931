#include "geometry/kernel/surface_gap.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface moved(const Surface& surface, const Vec3& by) {
    Positions points = surface.points();
    for (Vec3& p : points) p += by;
    return surface.with_positions(std::move(points));
}

/// A triangle with a long edge from a to b.
Surface blade(const Vec3& a, const Vec3& b, const Vec3& tip) {
    return make_surface({a, b, tip}, {{0, 1, 2}});
}

void check_gap(const SurfaceGap& gap, double expected) {
    CHECK(gap.distance == Approx(expected).margin(1e-12));
    CHECK((gap.from - gap.to).norm() == Approx(gap.distance).margin(1e-12));
}

}  // namespace

SCENARIO("Segments have the distance of their nearest points", "[geometry][gap]") {
    const Vec3 o(0, 0, 0), x(2, 0, 0);
    check_gap(segment_gap(o, x, {1, -1, 3}, {1, 1, 3}), 3.0);  // crossing above each other
    check_gap(segment_gap(o, x, {0, 1, 0}, {2, 1, 0}), 1.0);   // parallel
    check_gap(segment_gap(o, x, {5, 4, 0}, {5, 9, 0}), 5.0);   // end to end
    check_gap(segment_gap(o, x, {1, 2, 0}, {1, 7, 0}), 2.0);   // end to the middle
    check_gap(segment_gap(o, o, {0, 0, 2}, {0, 0, 2}), 2.0);   // points
    check_gap(segment_gap(o, o, {-1, 0, 2}, {1, 0, 2}), 2.0);  // point and segment
    check_gap(segment_gap(o, x, {1, -1, 0}, {1, 1, 0}), 0.0);  // meeting
}

SCENARIO("The gap of two spheres is that of their centres without the radii", "[geometry][gap]") {
    const Surface ball = icosphere(5.0, 4);
    const Surface other = moved(icosphere(3.0, 4), {9, 2, -3});
    const SurfaceGap gap = smallest_gap(ball, other);
    CHECK(gap.distance == Approx(std::sqrt(94.0) - 8.0).epsilon(0.01));
    CHECK((gap.from - gap.to).norm() == Approx(gap.distance));
    CHECK(gap.from.norm() == Approx(5.0).epsilon(0.01));
    CHECK(smallest_gap(other, ball).distance == Approx(gap.distance).epsilon(1e-12));
}

SCENARIO("The gap between two edges is found though all corners are farther", "[geometry][gap]") {
    const Surface below = blade({-5, 0, 0}, {5, 0, 0}, {0, 0, -4});
    const Surface above = blade({0, -5, 1}, {0, 5, 1}, {0, 0, 6});
    check_gap(smallest_gap(below, above), 1.0);
    check_gap(smallest_gap(above, below), 1.0);
}

SCENARIO("Surfaces that touch or cross have no gap", "[geometry][gap]") {
    const Surface ball = icosphere(5.0, 3);
    check_gap(smallest_gap(ball, ball), 0.0);
    check_gap(smallest_gap(ball, moved(ball, {6, 1, 0})), 0.0);
    // A corner goes through the middle of a large triangle: only an edge and a face meet.
    const Surface plate = blade({-50, -50, 0}, {50, -50, 0}, {0, 80, 0});
    const Surface needle = blade({0, 0, -3}, {0.1, 0, 3}, {0, 0.1, 3});
    check_gap(smallest_gap(plate, needle), 0.0);
    check_gap(smallest_gap(needle, plate), 0.0);
}

SCENARIO("A surface within another one has the distance of the two walls", "[geometry][gap]") {
    CHECK(smallest_gap(icosphere(5.0, 4), icosphere(3.0, 4)).distance == Approx(2.0).epsilon(0.02));
}

SCENARIO("Points without triangles are no part of a surface", "[geometry][gap]") {
    const Surface near = make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 8.9}}, {{0, 1, 2}});
    check_gap(smallest_gap(near, blade({0, 0, 9}, {1, 0, 9}, {0, 1, 9})), 9.0);
    CHECK_THROWS_AS(smallest_gap(near, make_surface({{0, 0, 0}}, {})), InvalidInput);
}
