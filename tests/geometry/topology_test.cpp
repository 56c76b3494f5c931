#include <catch2/catch.hpp>

#include "geometry/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A closed surface has one-rings and no boundary", "[geometry][topology]") {
    GIVEN("a geodesic sphere") {
        const Surface sphere = icosphere(10.0, 2);
        const Topology& topology = *sphere.topology;
        THEN("Euler's characteristic is 2") {
            const auto edges = topology.rings().values.size() / 2;
            CHECK(static_cast<int>(sphere.vertex_count()) - static_cast<int>(edges) +
                      static_cast<int>(sphere.triangle_count()) ==
                  2);
        }
        THEN("there is no boundary loop") {
            CHECK(topology.boundary_loops().empty());
        }
    }
}

SCENARIO("An open tube has two boundary loops that follow its triangles", "[geometry][topology]") {
    const Surface tube = open_tube(2.0, 10.0, 16, 8);
    const auto loops = tube.topology->boundary_loops();
    REQUIRE(loops.size() == 2);
    CHECK(loops[0].size() == 16);
    CHECK(loops[1].size() == 16);
}

SCENARIO("A triangle that names a missing vertex is refused", "[geometry][topology]") {
    CHECK_THROWS_AS(make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 3}}),
                    InvalidInput);
}
