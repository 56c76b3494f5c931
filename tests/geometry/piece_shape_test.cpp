#include "geometry/kernel/piece_shape.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Some surfaces as the pieces of one.
struct Pieces {
    Positions points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> piece_of_triangle;
    std::size_t count = 0;

    void add(const Surface& surface, const Vec3& at) {
        const auto first = static_cast<VertexId>(points.size());
        for (const Vec3& p : surface.points()) points.push_back(p + at);
        for (const auto& [a, b, c] : surface.triangles()) {
            triangles.push_back({first + a, first + b, first + c});
            piece_of_triangle.push_back(static_cast<std::uint32_t>(count));
        }
        ++count;
    }

    [[nodiscard]] std::vector<PieceShape> shapes() const {
        return piece_shapes(points, triangles, piece_of_triangle, count);
    }
};

}  // namespace

SCENARIO("A piece of a surface is as long and wide as the vessel that it could be", "[geometry]") {
    GIVEN("a long thin tube and a sphere beside it, turned") {
        const Eigen::Matrix3d turn = skew_rotation();
        const auto turned = [&](const Surface& surface) {
            return mapped(surface, [&](const Vec3& p) { return Vec3(turn * p); });
        };
        Pieces pieces;
        pieces.add(turned(open_tube(1.0, 20.0, 48, 60)), {100.0, 0.0, 0.0});
        pieces.add(turned(icosphere(3.0, 4)), {0.0, 50.0, 0.0});
        const std::vector<PieceShape> shapes = pieces.shapes();
        THEN("the tube has its length and diameter, and is a vessel") {
            REQUIRE(shapes.size() == 2);
            CHECK(shapes[0].length == Approx(std::hypot(20.0, 2.0)).epsilon(0.01));
            CHECK(shapes[0].diameter == Approx(2.0).epsilon(0.02));
            CHECK(shapes[0].is_vessel());
            CHECK((shapes[0].centre - (turn * Vec3(0, 0, 10) + Vec3(100, 0, 0))).norm() < 0.01);
        }
        THEN("the sphere is as long as it is wide, and none") {
            CHECK(shapes[1].length == Approx(6.0).epsilon(0.01));
            CHECK(shapes[1].diameter == Approx(6.0).epsilon(0.02));
            CHECK_FALSE(shapes[1].is_vessel());
            CHECK((shapes[1].centre - Vec3(0, 50, 0)).norm() < 0.01);
        }
    }
}

SCENARIO("Of the pieces that are dropped, a vessel is told, but no crumb", "[geometry]") {
    Pieces pieces;
    pieces.add(open_tube(2.0, 100.0, 24, 40), {0, 0, 0});
    pieces.add(icosphere(10.0, 2), {50, 0, 0});
    pieces.add(open_tube(0.5, 4.0, 24, 20), {0, 50, 0});  // 4 % of the longest
    GIVEN("a ball and a crumb that are dropped") {
        THEN("neither is told") {
            CHECK_FALSE(longest_dropped_vessel(pieces.shapes(), {true, false, false}));
        }
    }
    GIVEN("vessels that are dropped, too") {
        pieces.add(open_tube(1.0, 20.0, 24, 20), {0, 100, 0});
        pieces.add(open_tube(1.0, 30.0, 24, 20), {0, 150, 0});
        const std::vector<PieceShape> shapes = pieces.shapes();
        THEN("the longest of them is told") {
            const auto told = longest_dropped_vessel(shapes, {true, false, false, false, false});
            REQUIRE(told);
            CHECK(told->piece == 4);
        }
        THEN("one that is kept is not") {
            const auto told = longest_dropped_vessel(shapes, {true, false, false, false, true});
            REQUIRE(told);
            CHECK(told->piece == 3);
        }
    }
}
