#include "geometry/kernel/wall_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/statistics.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("The angles at the edges of a wall", "[geometry][wall-edges]") {
    GIVEN("a cube: twelve edges of 90 degrees and a flat diagonal on each side") {
        std::vector<double> angles = wall_edges(cube(2.0)).angles;
        REQUIRE(angles.size() == 18);
        std::ranges::sort(angles);
        for (std::size_t i = 0; i < 18; ++i)
            CHECK(angles[i] == Approx(i < 6 ? 0.0 : 90.0).margin(1e-9));
    }
    GIVEN("a tube of 24 sides with caps, whose rims do not count") {
        const WallEdges edges = wall_edges(closed_tube(2.0, 20.0, 24, 10));
        CHECK(std::ranges::max(edges.angles) == Approx(15.0));
        CHECK(std::ranges::min(edges.angles) == Approx(0.0).margin(1e-6));
    }
    GIVEN("triangles that overlap, folded back") {
        const Surface fold = make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                                          {Triangle{0, 1, 2}, Triangle{1, 0, 2}});
        for (const double angle : wall_edges(fold).angles) CHECK(angle == Approx(180.0));
    }
}

SCENARIO("The sizes of neighbouring triangles", "[geometry][wall-edges]") {
    const Positions points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 4, 0)};
    GIVEN("two whose heights are 1 and 4 over the same edge") {
        const WallEdges edges =
            wall_edges(make_surface(points, {Triangle{0, 2, 1}, Triangle{0, 1, 3}}));
        REQUIRE(edges.size_ratios.size() == 1);
        CHECK(edges.size_ratios[0] == Approx(2.0));
    }
    GIVEN("one without area, the edge is left out") {
        Positions flat = points;
        flat[2] = Vec3(2, 0, 0);
        const WallEdges edges =
            wall_edges(make_surface(flat, {Triangle{0, 2, 1}, Triangle{0, 1, 3}}));
        CHECK(edges.size_ratios.empty());
        CHECK(edges.angles.empty());
    }
}

SCENARIO("The percentile of weighted values", "[geometry][wall-edges]") {
    const std::vector<double> values = {3.0, 1.0, 2.0}, weights = {1.0, 8.0, 1.0};
    CHECK(weighted_percentile(values, weights, 0.0) == 1.0);
    CHECK(weighted_percentile(values, weights, 0.79) == 1.0);
    CHECK(weighted_percentile(values, weights, 0.85) == 2.0);
    CHECK(weighted_percentile(values, weights, 1.0) == 3.0);
}

SCENARIO("The triangles of a tube beside its radius", "[geometry][wall-edges]") {
    const double edge = 2.0 * std::numbers::pi * 2.0 / 48.0;
    for (const double scale : {1.0, 10.0}) {
        const Surface tube =
            mapped(fine_tube(2.0, 30.0, 48), [&](const Vec3& p) -> Vec3 { return scale * p; });
        const WallResolution found = wall_resolution(tube, SurfaceDistance(tube));
        CHECK(median(found.edges_around) == Approx(48.0).epsilon(0.03));
        CHECK(median(found.sags) == Approx(scale * edge * edge / 16.0).epsilon(0.05));
    }
    THEN("a coarse half of the wall weighs as much as a fine one") {
        // Nine in ten of the triangles are in the lower half.
        const Surface graded = mapped(fine_tube(2.0, 30.0, 48), [](const Vec3& p) {
            return Vec3(p.x(), p.y(), p.z() < 27.0 ? p.z() / 1.8 : 15.0 + 5.0 * (p.z() - 27.0));
        });
        WallResolution found = wall_resolution(graded, SurfaceDistance(graded));
        REQUIRE(found.areas.size() == found.edges_around.size());
        const double coarse = weighted_percentile(found.edges_around, found.areas, 0.4);
        const double fine = weighted_percentile(found.edges_around, found.areas, 0.75);
        CHECK(coarse < 0.7 * fine);
        CHECK(percentile(found.edges_around, 0.4) == Approx(fine).epsilon(0.1));
    }
    THEN("some of the triangles are enough") {
        const Surface tube = fine_tube(2.0, 30.0, 48);
        const WallResolution found = wall_resolution(tube, SurfaceDistance(tube), 500);
        CHECK(found.edges_around.size() < 1000);
        CHECK(median(found.edges_around) == Approx(48.0).epsilon(0.03));
    }
    THEN("a sheet has no wall opposite") {
        const Surface sheet =
            make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {Triangle{0, 1, 2}});
        CHECK(wall_resolution(sheet, SurfaceDistance(sheet)).edges_around.empty());
    }
}
