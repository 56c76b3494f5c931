#include "smoothing/context/context_finder.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "smoothing/context/staircases.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A finder finds what smoothing finds of a surface", "[smoothing][context-finder]") {
    const Surface tube = fine_tube(3.0, 12.0, 48);
    const auto finder = make_cpu_finder(tube);
    GIVEN("caps, which are found once") {
        const std::vector<Cap>& caps = finder->caps();
        CHECK(caps.size() == 2);
        CHECK(&finder->caps() == &caps);
        CHECK(cap_vertices(caps, tube.vertex_count()) ==
              cap_vertices(find_caps(tube), tube.vertex_count()));
    }
    GIVEN("staircases: the tube's rims, if they are no caps'") {
        const StaircaseParameters parameters{.tau_theta = 0.9, .tau_max = 1.0};
        const StaircaseContext found = finder->staircases(Vec3(0, 0, 2), parameters);
        CHECK(found.vertices == 96);
        CHECK(std::ranges::count(found.weights, 1.0) == 96);
        CHECK(found.weights ==
              staircase_weights(*tube.topology, tube.points(),
                                orientation_change(*tube.topology, tube.points(), Vec3::UnitZ()),
                                parameters));
        const auto caps = cap_vertices(finder->caps(), tube.vertex_count());
        const StaircaseContext none =
            finder->staircases(Vec3::UnitZ(), {.tau_theta = 0.9, .tau_max = 1.0, .caps = caps});
        CHECK(none.vertices == 0);
        CHECK(std::ranges::max(none.weights) == 0.0);
    }
    GIVEN("a neighbour beside the tube") {
        const std::vector<Surface> neighbours{icosphere(1.0, 4, Vec3(6.0, 0.0, 6.0))};
        const NeighbourContext found = finder->neighbours(neighbours, {});
        const auto distances = neighbour_distances(tube.points(), neighbours);
        CHECK(found.least == std::ranges::min(distances));
        CHECK(found.least == Approx(2.0).margin(0.02));
        CHECK(found.most == std::ranges::max(distances));
        CHECK(found.weights == distance_weights(distances));
    }
    GIVEN("what makes no sense") {
        CHECK_THROWS_AS(finder->staircases(Vec3::Zero(), {}), InvalidInput);
        CHECK_THROWS_AS(finder->staircases(Vec3::UnitZ(), {.tau_max = 0.0}), InvalidInput);
        CHECK_THROWS_AS(finder->neighbours({}, {}), InvalidInput);
    }
}
