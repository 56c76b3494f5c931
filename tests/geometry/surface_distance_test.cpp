#include "geometry/kernel/surface_distance.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Points spread over a box around the origin, the same in every run.
Positions scattered(std::size_t count, double reach) {
    Positions points;
    std::uint32_t state = 12345;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return reach * (2.0 * (state >> 8) / 16777216.0 - 1.0);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const double x = next(), y = next(), z = next();
        points.emplace_back(x, y, z);
    }
    return points;
}

}  // namespace

SCENARIO("Distances agree with trying all triangles", "[geometry][surface_distance]") {
    const Surface sphere = icosphere(1.0, 3);
    const SurfaceDistance distance(sphere);
    for (const Vec3& p : scattered(300, 1.5)) {
        double brute = std::numeric_limits<double>::infinity();
        for (const Triangle& t : sphere.triangles()) {
            const auto& x = sphere.points();
            brute = std::min(brute,
                             (closest_point_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]) - p).norm());
        }
        const SurfacePoint found = distance.closest_point(p);
        CHECK(found.distance == Approx(brute).margin(1e-14));
        CHECK((found.point - p).norm() == Approx(found.distance).margin(1e-14));
        CHECK(distance.closest_point(p, brute * 1.0001).has_value());
        CHECK_FALSE(distance.closest_point(p, brute * 0.999).has_value());
    }
}

SCENARIO("The inside of closed and open surfaces is known", "[geometry][surface_distance]") {
    const SurfaceDistance sphere(icosphere(1.0, 3));
    for (const Vec3& p : scattered(500, 1.5))
        if (std::abs(p.norm() - 1.0) > 0.02) CHECK(sphere.inside(p) == (p.norm() < 1.0));
    CHECK(sphere.signed_distance(Vec3(0, 0, 0)) == Approx(-1.0).epsilon(0.02));
    CHECK(sphere.signed_distance(Vec3(0, 0, 3)) == Approx(2.0).epsilon(0.02));
    const SurfaceDistance tube(open_tube(1.0, 20.0, 32, 40));
    CHECK(tube.inside(Vec3(0.5, 0.2, 10)));
    CHECK_FALSE(tube.inside(Vec3(1.2, 0.2, 10)));
    CHECK_FALSE(tube.inside(Vec3(0, 0, 22)));
}

SCENARIO("Rays meet a tube's walls", "[geometry][surface_distance]") {
    const SurfaceDistance tube(open_tube(1.0, 10.0, 64, 40));
    const auto hit = tube.first_hit(Vec3(0, 0, 5), Vec3(3, 0, 0));
    REQUIRE(hit);
    CHECK(hit->distance == Approx(1.0).epsilon(1e-9));
    CHECK(hit->from_inside);
    CHECK_FALSE(tube.first_hit(Vec3(0, 0, 5), Vec3(0, 0, 1)));
    CHECK_FALSE(tube.first_hit(Vec3(0, 0, 5), Vec3(1, 0, 0), 0.5));
    const auto all = tube.all_hits(Vec3(-5, 0.1, 5.1), Vec3(1, 0, 0));
    REQUIRE(all.size() == 2);
    CHECK_FALSE(all[0].from_inside);
    CHECK(all[1].from_inside);
    CHECK(all[1].distance - all[0].distance == Approx(2.0 * std::sqrt(0.99)).epsilon(0.01));
}

SCENARIO("Triangles near a point are all found", "[geometry][surface_distance]") {
    const Surface sphere = icosphere(1.0, 3);
    const SurfaceDistance distance(sphere);
    CHECK(distance.triangles_within(Vec3(0, 0, 0), 2.0).size() == sphere.triangle_count());
    CHECK(distance.triangles_within(Vec3(0, 0, 0), 0.5).empty());
    const auto near = distance.triangles_within(Vec3(0, 0, 1), 0.3);
    std::size_t brute = 0;
    for (const Triangle& t : sphere.triangles()) {
        const auto& x = sphere.points();
        const Vec3 q = closest_point_on_triangle(Vec3(0, 0, 1), x[t[0]], x[t[1]], x[t[2]]);
        brute += (q - Vec3(0, 0, 1)).norm() <= 0.3 ? 1 : 0;
    }
    CHECK(near.size() == brute);
}

SCENARIO("Batches give the results of single queries in order", "[geometry][surface_distance]") {
    const SurfaceDistance distance(icosphere(1.0, 3));
    const Positions points = scattered(1000, 1.5);
    const auto batch = distance.closest_points(points);
    const auto sides = distance.signed_distances(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(batch[i].triangle == distance.closest_point(points[i]).triangle);
        CHECK(sides[i] == distance.signed_distance(points[i]));
    }
}

SCENARIO("A surface without triangles has no distances", "[geometry][surface_distance]") {
    CHECK_THROWS_AS(SurfaceDistance(Surface{}), InvalidInput);
}
