#include "meshing/layers/wall_layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "meshing/layers/layer_directions.h"
#include "meshing/layers/layer_report.h"
#include "meshing/layers/touching_balls.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

constexpr double kRadius = 2.0;  // [mm], of every tube here

Surface straight_tube() {
    return test::fine_tube(kRadius, 12.0, 30);
}

// From kRadius at z = 0 to a part of it at z = 12.
Surface tapered_tube(double part) {
    return test::mapped(straight_tube(), [part](const Vec3& p) {
        const double by = 1.0 + (part - 1.0) * p.z() / 12.0;
        return Vec3(by * p.x(), by * p.y(), p.z());
    });
}

// Around a circle of a radius [mm] in the plane y = 0.
Surface bent_tube(double bend) {
    return test::mapped(straight_tube(), [bend](const Vec3& p) {
        const double angle = p.z() / bend, r = bend + p.x();
        return Vec3(r * std::cos(angle) - bend, p.y(), r * std::sin(angle));
    });
}

double scaled_error(double value, double exact) {
    return std::abs(value / exact - 1.0);
}

}  // namespace

SCENARIO("touching balls measure curvature and the wall opposite", "[meshing][layers]") {
    GIVEN("a tube of radius 2 mm") {
        const LayeredWall wall = layered_wall(straight_tube());
        const std::vector<double> balls = touching_balls(wall);
        THEN("they have its radius, at its rims too") {
            for (const double ball : balls) REQUIRE(scaled_error(ball, kRadius) < 0.02);
        }
        THEN("so has the vessel") {
            for (const double radius : vessel_radii(wall, balls))
                REQUIRE(scaled_error(radius, kRadius) < 0.02);
        }
    }
    GIVEN("a sphere of radius 3 mm") {
        THEN("they are the sphere") {
            for (const double ball : touching_balls(layered_wall(test::icosphere(3.0, 4))))
                REQUIRE(scaled_error(ball, 3.0) < 0.02);
        }
    }
    GIVEN("a flat tube, 4 mm wide and 1 mm high") {
        const Surface flat = test::mapped(
            straight_tube(), [](const Vec3& p) { return Vec3(p.x(), 0.25 * p.y(), p.z()); });
        const LayeredWall wall = layered_wall(flat);
        const std::vector<double> balls = touching_balls(wall);
        THEN("at its sides they are as small as its curvature, in its middle half its height") {
            for (VertexId v = 0; v < balls.size(); ++v) {
                const Vec3& p = wall.wall.points()[v];
                if (std::abs(p.x()) < 0.3) CHECK(balls[v] == Approx(0.5).epsilon(0.1));
                if (std::abs(p.x()) > 1.99) CHECK(balls[v] < 0.3);
            }
        }
    }
}

SCENARIO("the most normal direction sees all triangles, if one does", "[meshing][layers]") {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const std::vector<Vec3> corner = {x, y, z};
    CHECK((most_normal(corner).normalized() - (x + y + z).normalized()).norm() < 1e-4);
    const std::vector<Vec3> unequal = {x, x, x, x, y};
    CHECK((most_normal(unequal).normalized() - (x + y).normalized()).norm() < 1e-4);
    const std::vector<Vec3> fold = {x, y, -(x + y).normalized()};
    CHECK(most_normal(fold).norm() < 1e-3);
}

SCENARIO("layers have the heights that were asked for", "[meshing][layers]") {
    GIVEN("a tube, and four layers of together 0.2 of its radius") {
        const WallLayers layers = wall_layers(straight_tube(), {.layers = 4});
        THEN("every column is so long, and the inner surface a tube of 0.8 R") {
            for (const double length : layers.lengths)
                REQUIRE(length == Approx(0.2 * kRadius).epsilon(0.02));
            for (const VertexId v : layers.wall.origins)
                REQUIRE(std::hypot(layers.inner.points()[v].x(), layers.inner.points()[v].y()) ==
                        Approx(0.8 * kRadius).epsilon(0.01));
        }
        THEN("each layer is 1.2 times as high as the one outside of it") {
            const std::vector<double>& levels = layers.levels;
            REQUIRE(levels.size() == 5);
            CHECK(levels.back() == 1.0);
            for (std::size_t k = 2; k < levels.size(); ++k)
                CHECK((levels[k] - levels[k - 1]) / (levels[k - 1] - levels[k - 2]) == Approx(1.2));
        }
        THEN("the report says that the whole wall is covered and nothing limited") {
            const LayerReport report = layer_report(layers);
            CHECK(report.covered == Approx(1.0));
            CHECK(report.limited == 0.0);
            CHECK(report.places.empty());
            CHECK(report.thickness == Approx(0.2 * kRadius).epsilon(0.02));
        }
    }
    GIVEN("a first height of 0.05 mm") {
        const WallLayers layers = wall_layers(straight_tube(), {.layers = 3, .first = 0.05});
        THEN("the first layer has it") {
            for (const double length : layers.lengths)
                REQUIRE(length * layers.levels[1] == Approx(0.05).epsilon(0.01));
        }
    }
    GIVEN("a thickness of 0.3 mm in a tapered tube") {
        const WallLayers layers =
            wall_layers(tapered_tube(0.5), {.layers = 2, .thickness_mm = 0.3});
        THEN("it is the same everywhere") {
            for (VertexId v = 0; v < layers.lengths.size(); ++v)
                REQUIRE(-layers.lengths[v] * layers.directions[v].dot(layers.wall.normals[v]) ==
                        Approx(0.3).epsilon(0.02));
        }
    }
    GIVEN("a tapered tube and a share of its radius") {
        const WallLayers layers = wall_layers(tapered_tube(0.5), {.layers = 2});
        THEN("the thickness follows the radius") {
            for (VertexId v = 0; v < layers.lengths.size(); ++v) {
                const Vec3& p = layers.wall.wall.points()[v];
                if (p.z() < 3.0 || p.z() > 9.0) continue;
                REQUIRE(layers.lengths[v] == Approx(0.2 * std::hypot(p.x(), p.y())).epsilon(0.1));
            }
        }
    }
    GIVEN("a thickness that the lumen has no room for") {
        const WallLayers layers = wall_layers(straight_tube(), {.layers = 2, .thickness_mm = 3.0});
        THEN("it is limited to 0.45 of the radius, and the report says so") {
            for (const double length : layers.lengths) REQUIRE(length <= 0.4501 * kRadius);
            const LayerReport report = layer_report(layers);
            CHECK(report.limited == Approx(1.0));
            CHECK(report.half == Approx(1.0));
            CHECK_FALSE(report.places.empty());
        }
    }
}

SCENARIO("openings stay flat, with columns of the rim in them", "[meshing][layers]") {
    for (const Surface& tube : {straight_tube(), tapered_tube(0.6), bent_tube(6.0)}) {
        const WallLayers layers = wall_layers(tube, {.layers = 4});
        for (std::size_t patch = 1; patch < tube.patches.size(); ++patch) {
            const Vec3& plane = layers.wall.planes[patch];
            Vec3 on = Vec3::Zero();
            for (TriangleId t = 0; t < tube.triangle_count(); ++t)
                if ((*tube.patch_labels)[t] == patch) on = tube.points()[tube.triangles()[t][0]];
            for (TriangleId t = 0; t < tube.triangle_count(); ++t) {
                if ((*tube.patch_labels)[t] != patch) continue;
                for (const VertexId v : tube.triangles()[t])
                    REQUIRE(std::abs(plane.dot(layers.inner.points()[v] - on)) < 1e-9 * kRadius);
                REQUIRE(area_normal(layers.inner.points(), tube.triangles()[t]).dot(plane) > 0.0);
            }
        }
    }
}

SCENARIO("an opening that is not flat is named", "[meshing][layers]") {
    const Surface dented = test::mapped(straight_tube(), [](const Vec3& p) {
        return Vec3(p.x(), p.y(), p.z() + (p.z() > 11.99 ? 0.05 * p.x() * p.x() : 0.0));
    });
    try {
        (void)wall_layers(dented, {.layers = 2});
        FAIL("was not refused");
    } catch (const DiagnosedInput& failure) {
        const Diagnostic& what = failure.diagnostics().front();
        CHECK(what.code == "layers-opening-not-flat");
        CHECK(what.words.at("opening") == "outlet_1");
    }
}

SCENARIO("layers do not depend on how the vessel lies", "[meshing][layers]") {
    const Surface tube = bent_tube(6.0);
    const Surface turned = test::mapped(tube, [](const Vec3& p) {
        return Vec3(test::skew_rotation() * p + Vec3(3.0, -7.0, 11.0));
    });
    const WallLayers one = wall_layers(tube, {.layers = 4}),
                     other = wall_layers(turned, {.layers = 4});
    for (std::size_t v = 0; v < one.lengths.size(); ++v)
        REQUIRE(other.lengths[v] == Approx(one.lengths[v]).epsilon(1e-6));
}

SCENARIO("a tight bend thins the layers evenly instead of folding them", "[meshing][layers]") {
    GIVEN("a bend whose inner side has a radius of 0.5 mm, and layers of 0.4 R") {
        const Surface tube = bent_tube(2.5);
        const WallLayers layers = wall_layers(tube, {.layers = 4, .thickness = 0.4});
        THEN("neighbours differ by at most 0.4 of their distance") {
            const CompressedRows& rings = layers.wall.wall.topology->rings();
            for (VertexId v = 0; v < layers.lengths.size(); ++v)
                for (const VertexId u : rings.row(v)) {
                    const double apart =
                        (layers.wall.wall.points()[u] - layers.wall.wall.points()[v]).norm();
                    REQUIRE(layers.lengths[v] <= layers.lengths[u] + 0.4001 * apart);
                }
        }
    }
}

SCENARIO("layers are refused with a place where they cannot grow", "[meshing][layers]") {
    GIVEN("a tube with a vertex of its wall pulled past its neighbours") {
        const Surface tube = straight_tube();
        Positions points = tube.points();
        VertexId pulled = 0;
        for (VertexId v = 0; v < points.size(); ++v)
            if (std::abs(points[v].z() - 6.0) < 0.3 &&
                std::hypot(points[v].x(), points[v].y()) > 1.9)
                pulled = v;
        points[pulled].z() += 0.8;  // past its neighbours, which are 0.4 mm away
        THEN("the refusal names the fold's place") {
            try {
                (void)wall_layers(tube.with_positions(points), {.layers = 4});
                FAIL("was not refused");
            } catch (const DiagnosedFailure& failure) {
                const Diagnostic& what = failure.diagnostics().front();
                CHECK(what.code == "layers-at-fold");
                REQUIRE(what.place);
                CHECK((*what.place - points[pulled]).norm() < 1.5);
            }
        }
    }
}
