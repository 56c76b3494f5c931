#include "geometry/kernel/solid_surface.h"

#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/edges.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A surface is solid if its inner side is seen from inside only", "[geometry][solid]") {
    CHECK(is_solid_surface(icosphere(3.0, 3, Vec3(9, 8, 7))));
    CHECK(is_solid_surface(closed_tube(2.0, 20.0, 24, 20)));
    CHECK_FALSE(is_solid_surface(open_tube(2.0, 20.0, 24, 20)));
    CHECK_FALSE(is_solid_surface(flipped(icosphere(3.0, 3))));
    CHECK_FALSE(is_solid_surface(sphere_shell(8.0, 2.0, 3)));
    const Surface sphere = icosphere(3.0, 3);
    std::vector<Triangle> triangles(sphere.triangles().begin(), sphere.triangles().end());
    std::swap(triangles[5][0], triangles[5][1]);
    CHECK_FALSE(is_solid_surface(make_surface(sphere.points(), triangles)));
}
