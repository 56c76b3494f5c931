#include "geometry/vessel/openings/extrude.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kPi = std::numbers::pi;

/// A tube of elliptic section along z with labelled caps.
Surface elliptic_tube(double a, double b, double length) {
    return mapped(closed_tube(1.0, length, 48, 40),
                  [=](const Vec3& p) { return Vec3(a * p.x(), b * p.y(), p.z()); });
}

}  // namespace

SCENARIO("An opening is extruded along its normal", "[geometry][extrude]") {
    const Surface tube = closed_tube(2.0, 20.0, 48, 60);
    GIVEN("a round opening whose profile is kept") {
        const auto [longer, length, shortened] = extrude_opening(
            tube, 2, {.length = 8.0, .profile = ExtrusionProfile::Keep, .blend = 0.5});
        THEN("the vessel is longer by just that, and the cap has moved") {
            CHECK(length == 8.0);
            CHECK_FALSE(shortened);
            CHECK(is_closed_manifold(longer));
            CHECK(enclosed_volume(longer) ==
                  Approx(enclosed_volume(tube) * 28.0 / 20.0).epsilon(1e-3));
            CHECK(longer.patches == tube.patches);
            CHECK(patch_shape(longer, 2).plane.point.z() == Approx(28.0));
            CHECK(patch_shape(longer, 2).flatness < 1e-9);
            CHECK(patch_shape(longer, 1).plane.point.z() == Approx(0.0).margin(1e-12));
            CHECK(opening_tilt_deg(longer, 2) < 0.01);
        }
        THEN("the new triangles are as large as those at the rim, and well shaped") {
            const double edge = 2.0 * kPi * 2.0 / 48.0;
            for (TriangleId t = 0; t < longer.triangle_count(); ++t) {
                const auto& c = longer.triangles()[t];
                if (longer.points()[c[0]].z() < 20.5) continue;
                CHECK(0.5 * area_normal(longer.points(), c).norm() <
                      2.0 * edge * edge * std::sqrt(3.0) / 4.0);
            }
            CHECK(smallest_angle_deg(longer, [](const Vec3& p) { return p.z() > 20.5; }) > 25.0);
        }
    }
    GIVEN("an elliptic opening that becomes a circle") {
        const Surface ellipse = elliptic_tube(3.0, 1.5, 20.0);
        const auto longer = extrude_opening(ellipse, 2, {.length = 10.0, .blend = 0.6}).surface;
        THEN("the area is kept along the way, and the end is round") {
            CHECK(is_closed_manifold(longer));
            const double area = patch_shape(ellipse, 2).area;
            CHECK(patch_shape(longer, 2).area == Approx(area).epsilon(1e-9));
            CHECK(enclosed_volume(longer) - enclosed_volume(ellipse) ==
                  Approx(10.0 * area).epsilon(5e-3));
            double least = 1e9, most = 0.0;
            for (const Vec3& p : longer.points())
                if (p.z() > 26.1) {
                    const double r = std::hypot(p.x(), p.y());
                    if (r > 2.0) least = std::min(least, r);
                    most = std::max(most, r);
                }
            CHECK(most == Approx(std::sqrt(area / kPi)).epsilon(5e-3));
            CHECK(least > 0.995 * most);
        }
        THEN("both ends can be extruded") {
            const auto both = extrude_opening(longer, 1, {.length = 5.0}).surface;
            CHECK(is_closed_manifold(both));
            CHECK(patch_shape(both, 1).plane.point.z() == Approx(-5.0));
        }
    }
}

SCENARIO("An opening is extruded along its vessel", "[geometry][extrude]") {
    GIVEN("a tube that leans 30 degrees, with caps across z") {
        const double lean = std::tan(kPi / 6.0);
        const Surface tube = mapped(closed_tube(2.0, 20.0, 48, 60), [=](const Vec3& p) {
            return Vec3(p.x() + lean * p.z(), p.y(), p.z());
        });
        const Vec3 along = Vec3(lean, 0.0, 1.0);
        const auto [longer, length, shortened] = extrude_opening(
            tube, 2,
            {.length = 8.0, .direction = along, .profile = ExtrusionProfile::Keep, .blend = 0.5});
        THEN("it goes on straight, and the cap has moved by the length along it") {
            CHECK(length == 8.0);
            CHECK_FALSE(shortened);
            CHECK(is_closed_manifold(longer));
            const Vec3 end = patch_shape(longer, 2).plane.point;
            CHECK((end - (20.0 * along + 8.0 * along.normalized())).norm() < 1e-6);
            CHECK(enclosed_volume(longer) ==
                  Approx(enclosed_volume(tube) * end.z() / 20.0).epsilon(1e-3));
        }
        THEN("its directions are limited") {
            CHECK_THROWS_AS(
                extrude_opening(tube, 2, {.length = 8.0, .direction = Vec3(3.0, 0.0, 1.0)}),
                InvalidInput);
        }
    }
}

SCENARIO("An extrusion stops before it hits another vessel", "[geometry][extrude]") {
    const Surface tube = closed_tube(2.0, 20.0, 48, 60);
    const Surface across =
        mapped(tube, [](const Vec3& p) { return Vec3(p.z() - 10.0, -p.y(), p.x() + 32.0); });
    const Surface wall =
        make_surface(across.points(), {across.triangles().begin(), across.triangles().end()});
    GIVEN("a vessel across the way, 10 mm ahead") {
        const Surface both = merged(tube, wall);
        const auto extrusion = extrude_opening(both, 2, {.length = 15.0});
        THEN("it is shortened and says so") {
            CHECK(extrusion.shortened);
            CHECK(extrusion.length < 9.1);
            CHECK(extrusion.length > 7.0);
        }
    }
    GIVEN("a vessel just ahead") {
        const Surface near =
            mapped(wall, [](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() - 8.5); });
        const Extrusion none = extrude_opening(merged(tube, near), 2, {.length = 15.0});
        CHECK(none.length == 0.0);
        CHECK(none.shortened);
        CHECK(none.surface.points() == merged(tube, near).points());
    }
    GIVEN("bad arguments") {
        CHECK_THROWS_AS(extrude_opening(tube, 0, {.length = 1.0}), InvalidInput);
        CHECK_THROWS_AS(extrude_opening(tube, 2, {.length = 0.0}), InvalidInput);
        CHECK_THROWS_AS(extrude_opening(tube, 7, {.length = 1.0}), InvalidInput);
    }
    GIVEN("a length in another unit") {
        for (const double length : {1e4, 1e5, 1e308})
            CHECK_THROWS_WITH(extrude_opening(tube, 2, {.length = length}),
                              Contains("out of proportion") && Contains("give at most 2.08e+03"));
    }
    GIVEN("a rim so fine that the tube would fill the memory") {
        const Surface fine = closed_tube(2.0, 20.0, 6000, 1);
        CHECK_THROWS_WITH(extrude_opening(fine, 2, {.length = 50.0}),
                          Contains("4 million triangles") && Contains("use length="));
    }
}
