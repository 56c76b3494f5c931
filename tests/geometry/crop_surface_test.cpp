#include "geometry/vessel/openings/crop_surface.h"

#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A surface is cut open at a box", "[crop]") {
    const Surface tube = closed_tube(2.0, 20.0, 60, 40);
    GIVEN("a box that holds the middle of a tube") {
        const Surface part = crop_to_box(tube, Vec3(-5, -5, 4.3), Vec3(5, 5, 12.7));
        THEN("both ends are open, exactly in the box's planes") {
            const auto loops = part.topology->boundary_loops();
            REQUIRE(loops.size() == 2);
            for (const auto& loop : loops)
                for (const VertexId v : loop) {
                    const double z = part.points()[v].z();
                    CHECK(std::min(std::abs(z - 4.3), std::abs(z - 12.7)) < 1e-12);
                }
            CHECK(area(part) == Approx(area(open_tube(2.0, 8.4, 60, 1))));
        }
        THEN("the caps are gone, the wall is left") {
            CHECK(part.patches.size() == 1);
        }
    }
    GIVEN("a box that holds one end") {
        const Surface part = crop_to_box(tube, Vec3(-5, -5, 15), Vec3(5, 5, 25));
        THEN("that end's patch stays") {
            REQUIRE(part.patches.size() == 2);
            CHECK(part.patches[1].name == "outlet_1");
        }
    }
    GIVEN("a box through vertices") {
        const Surface part = crop_to_box(tube, Vec3(-5, -5, 5), Vec3(5, 5, 10));
        THEN("no sliver arises") {
            CHECK(part.triangle_count() == 60 * 10 * 2);
            CHECK(part.topology->boundary_loops().size() == 2);
        }
    }
    THEN("an empty box and an empty result are refused") {
        CHECK_THROWS_AS(crop_to_box(tube, Vec3(1, 0, 0), Vec3(0, 1, 1)), InvalidInput);
        CHECK_THROWS_AS(crop_to_box(tube, Vec3(50, 0, 0), Vec3(60, 1, 1)), AlgorithmFailure);
    }
}

SCENARIO("A surface is cut open at a ball, with its attributes", "[crop]") {
    Surface plane_ball = icosphere(10.0, 4);
    std::vector<double> heights;
    for (const Vec3& p : plane_ball.points()) heights.push_back(p.z());
    plane_ball.attributes["height"] = std::make_shared<const std::vector<double>>(heights);
    const Surface part = crop_to_sphere(plane_ball, Vec3(0, 0, 10), 6.0);
    const auto loops = part.topology->boundary_loops();
    REQUIRE(loops.size() == 1);
    for (const VertexId v : loops[0])
        CHECK((part.points()[v] - Vec3(0, 0, 10)).norm() == Approx(6.0));
    for (VertexId v = 0; v < part.vertex_count(); ++v)
        CHECK((*part.attributes.at("height"))[v] == Approx(part.points()[v].z()));
    // A cap cut by a ball about a point of the sphere has the area pi r^2.
    CHECK(area(part) == Approx(std::numbers::pi * 36.0).epsilon(0.01));
}

SCENARIO("The largest piece is found by area", "[crop]") {
    const Surface tube = closed_tube(2.0, 20.0, 60, 40);
    const Surface halves = crop_to_box(tube, Vec3(-5, -5, -1), Vec3(5, 5, 21));
    const LargestPiece one = largest_piece(halves);
    CHECK(one.pieces == 1);
    CHECK(one.surface.triangle_count() == tube.triangle_count());
}
