#include "workbench/review/page_wall.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

std::vector<double> deviations_of(const Surface& of, const Surface& to) {
    const SurfaceDistance distance(to);
    const std::vector<SurfacePoint> closest = distance.closest_points(of.points());
    return wall_deviations(of, to, closest, signed_distances(of, distance, closest));
}

std::optional<WallChange> change_from(const Surface& before, const Surface& after) {
    return wall_change(before, deviations_of(before, after), after, deviations_of(after, before),
                       1e-6);
}

/// Widened about z = 15 by at most `height` [mm], within 2 mm.
Surface widened(const Surface& tube, double height) {
    return mapped(tube, [&](const Vec3& p) {
        const double radius = std::hypot(p.x(), p.y());
        const double share = std::max(0.0, 1.0 - std::abs(p.z() - 15.0) / 2.0);
        if (radius < 1.0) return p;
        return Vec3(p.x() * (1.0 + height * share / radius),
                    p.y() * (1.0 + height * share / radius), p.z());
    });
}

}  // namespace

SCENARIO("A vessel's radius is measured across it", "[review]") {
    const Surface tube = closed_tube(3.0, 30.0, 32, 40);
    const auto radius = radius_near(tube, SurfaceDistance(tube), Vec3(3.0, 0.0, 15.0));
    REQUIRE(radius);
    CHECK(*radius == Approx(3.0).epsilon(0.02));
}

SCENARIO("A change of the wall is found beside its radius", "[review]") {
    const Surface tube = closed_tube(3.0, 30.0, 32, 40);
    const auto change = change_from(tube, widened(tube, 0.6));
    REQUIRE(change);
    CHECK(change->largest == Approx(0.6).epsilon(0.1));
    CHECK(change->usual < 0.5 * change->largest);
    CHECK(change->place.z() == Approx(15.0).margin(0.5));
    REQUIRE(change->radius);
    CHECK(*change->radius == Approx(3.0).epsilon(0.05));
    CHECK_FALSE(change_from(tube, tube));
}

SCENARIO("A change of the wall says to which side it went", "[review]") {
    const Surface tube = closed_tube(3.0, 30.0, 32, 40), wider = widened(tube, 0.6),
                  narrower = widened(tube, -0.6);
    CHECK_FALSE(change_from(tube, wider)->inward);
    CHECK(change_from(wider, tube)->inward);
    CHECK(change_from(tube, narrower)->inward);
    CHECK_FALSE(change_from(narrower, tube)->inward);
    const SurfaceDistance distance(tube);
    const auto values =
        signed_distances(narrower, distance, distance.closest_points(narrower.points()));
    CHECK(std::ranges::min(values) == Approx(-0.6).epsilon(0.1));
    CHECK(std::ranges::max(values) == Approx(0.0).margin(1e-6));
}

SCENARIO("A vessel that gets longer or shorter at an opening keeps its wall", "[review]") {
    const Surface tube = closed_tube(3.0, 30.0, 32, 60);
    const Surface longer = closed_tube(3.0, 40.0, 32, 80);
    CHECK_FALSE(change_from(tube, longer));
    CHECK_FALSE(change_from(longer, tube));
    CHECK_FALSE(change_from(open_tube(3.0, 30.0, 32, 60), open_tube(3.0, 40.0, 32, 80)));
}
