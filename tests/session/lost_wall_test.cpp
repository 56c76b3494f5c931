#include "workbench/session/lost_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("An end whose cap is cut obliquely may lose its far corner", "[session][overreach]") {
    const double length = 20.0, slope = std::tan(std::numbers::pi / 6.0);
    const Surface before = fine_tube(3.0, length, 24);
    // The cap turns about its middle, on which the end's tip lies.
    const Vec3 tip(0.0, 0.0, length);
    const Plane plane{tip, Vec3(slope, 0.0, 1.0).normalized()};
    const Surface after = mapped(before, [&](const Vec3& p) {
        return Vec3(p.x(), p.y(), std::min(p.z(), length - slope * p.x()));
    });
    StatedChange stated{.wall_lost = 0.9};
    const auto unnamed = lost_wall(stated, before, after);
    REQUIRE(unnamed);
    CHECK(unnamed->distance == Approx(1.5).margin(0.1));
    CHECK(unnamed->place.x() == Approx(3.0).margin(0.1));
    stated.named = {{tip, plane}};
    CHECK_FALSE(lost_wall(stated, before, after));
    THEN("no end elsewhere is an excuse") {
        stated.named = {{Vec3(0.0, 0.0, 0.0), Plane{Vec3::Zero(), -Vec3::UnitZ()}}};
        CHECK(lost_wall(stated, before, after));
    }
}
