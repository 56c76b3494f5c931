#include "geometry/vessel/repair/widen.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kWanted = 1.2;  // mm

/// A tube of 2 mm radius along z, 30 mm long, that is a thread of these half axes at z = 15.
Surface tube_with_thread(double a, double b) {
    return mapped(closed_tube(2.0, 30.0, 24, 90), [=](const Vec3& p) {
        const double away = std::min(1.0, std::abs(p.z() - 15.0) / 3.0);
        const auto half = [&](double axis) { return (axis + (2.0 - axis) * away) / 2.0; };
        return Vec3(half(a) * p.x(), half(b) * p.y(), p.z());
    });
}

/// Extent along x and y of the vertices near z = 15.
Eigen::Vector2d extent_of_thread(const Positions& points) {
    Eigen::Vector2d most = Eigen::Vector2d::Zero();
    for (const Vec3& p : points)
        if (std::abs(p.z() - 15.0) < 0.2) most = most.cwiseMax(2.0 * p.head<2>().cwiseAbs());
    return most;
}

}  // namespace

SCENARIO("A thread of the lumen becomes as wide as wanted and the rest stays",
         "[geometry][widen]") {
    const auto [a, b] = GENERATE(table<double, double>({{0.05, 0.05}, {0.1, 0.02}, {0.5, 0.4}}));
    const Surface tube = tube_with_thread(a, b);
    const Positions wide = widen(tube, kWanted);
    const Eigen::Vector2d extent = extent_of_thread(wide);
    CHECK(extent.minCoeff() == Approx(kWanted).epsilon(0.1));
    CHECK(extent.maxCoeff() < 1.3 * kWanted);
    const auto places = narrow_places(tube, kWanted);
    REQUIRE(places.size() == 1);
    CHECK(places[0].place.z() == Approx(15.0).margin(0.7));
    CHECK(places[0].width == Approx(2.0 * std::min(a, b)).margin(0.1));
    CHECK(narrow_places(tube.with_positions(wide), 0.9 * kWanted).empty());
    for (std::size_t v = 0; v < wide.size(); ++v)
        if (std::abs(tube.points()[v].z() - 15.0) > 6.0) CHECK(wide[v] == tube.points()[v]);
}

SCENARIO("Nothing moves where the lumen is wide enough", "[geometry][widen]") {
    const Surface tube = closed_tube(2.0, 30.0, 24, 90);  // with sharp edges at its flat ends
    CHECK(narrow_places(tube, 3.8).empty());
    CHECK(widen(tube, 3.8) == tube.points());
}

SCENARIO("Widening does not depend on the unit or the direction", "[geometry][widen]") {
    const Surface tube = tube_with_thread(0.1, 0.1);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Positions one = widen(tube, kWanted);
    const Positions other = widen(
        mapped(tube, [&](const Vec3& p) -> Vec3 { return 1000.0 * (turn * p); }), 1000.0 * kWanted);
    for (std::size_t v = 0; v < one.size(); ++v)
        CHECK((other[v] - 1000.0 * (turn * one[v])).norm() < 0.02 * 1000.0 * kWanted);
}

SCENARIO("Caps and rims stay where they are", "[geometry][widen]") {
    const Surface tube = open_tube(0.3, 20.0, 12, 40);
    const Positions wide = widen(tube, kWanted);
    for (const auto& loop : tube.topology->boundary_loops())
        for (const VertexId v : loop) CHECK(wide[v] == tube.points()[v]);
    CHECK(extent_of_thread(wide).x() == Approx(kWanted).epsilon(0.06));
}

SCENARIO("The corner at an oblique cap is no narrow place", "[geometry][widen]") {
    const Surface tube = mapped(closed_tube(2.0, 30.0, 48, 90), [](const Vec3& p) {
        return Vec3(p.x(), p.y(), p.z() + std::max(0.0, p.z() / 15.0 - 1.0) * 1.2 * p.x());
    });
    CHECK(narrow_places(tube, 0.8).empty());
}

SCENARIO("A width that is not positive is refused", "[geometry][widen]") {
    CHECK_THROWS_AS(widen(closed_tube(2.0, 30.0, 12, 10), 0.0), InvalidInput);
}

SCENARIO("A width in another unit is refused", "[geometry][widen]") {
    const Surface tube = closed_tube(2.0, 30.0, 12, 10);
    CHECK_THROWS_AS(widen(tube, 100.0), AlgorithmFailure);
    CHECK_THROWS_WITH(narrow_places(tube, 1e308), Catch::Contains("width = 1e+308"));
}
