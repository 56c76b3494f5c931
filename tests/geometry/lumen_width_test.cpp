#include "geometry/kernel/lumen_width.h"

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("The width of a tube is its diameter, however it lies", "[geometry][lumen-width]") {
    const double angle = GENERATE(0.0, 0.4, 1.1, 2.3);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(angle, Vec3(1, -2, 3).normalized()).toRotationMatrix();
    const SurfaceDistance wall(
        mapped(open_tube(2.0, 30.0, 96, 60), [&](const Vec3& p) -> Vec3 { return turn * p; }));
    const auto width = lumen_width(wall, turn * Vec3(2.0, 0.0, 15.0), turn * -Vec3::UnitX(), 100.0);
    REQUIRE(width);
    CHECK(*width == Approx(4.0).epsilon(0.012));
}

SCENARIO("A branch beside it does not make a tube wider", "[geometry][lumen-width]") {
    // A hole in the wall opposite, where one of the rays leaves.
    const Surface tube = open_tube(2.0, 30.0, 96, 60);
    std::vector<Triangle> rest;
    for (const Triangle& t : tube.triangles())
        if ((tube.points()[t[0]] - Vec3(-2.0, 0.0, 17.3)).norm() > 0.8) rest.push_back(t);
    const auto width = lumen_width(SurfaceDistance(tube.points(), rest), Vec3(2.0, 0.0, 15.0),
                                   -Vec3::UnitX(), 100.0);
    REQUIRE(width);
    CHECK(*width == Approx(4.0).epsilon(0.02));
}

SCENARIO("A cap beside it does not make a tube narrower", "[geometry][lumen-width]") {
    const Surface tube = closed_tube(2.0, 30.0, 96, 60);
    const double z = GENERATE(1.0, 15.0, 29.0);
    const auto width = lumen_width(SurfaceDistance(tube), Vec3(2.0, 0.0, z), -Vec3::UnitX(), 100.0);
    REQUIRE(width);
    CHECK(*width == Approx(4.0).epsilon(0.1));
}

SCENARIO("Where no ray hits a wall there is no width", "[geometry][lumen-width]") {
    const SurfaceDistance wall(open_tube(2.0, 30.0, 24, 20));
    CHECK_FALSE(lumen_width(wall, Vec3(2.0, 0.0, 15.0), Vec3::UnitX(), 100.0));
    CHECK_FALSE(lumen_width(wall, Vec3(2.0, 0.0, 15.0), -Vec3::UnitX(), 1.0));
}
