#include "gpu/gpu_context_finder.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, std::abs(a[v] - b[v]));
    return largest;
}

void compare(ContextFinder& device, ContextFinder& cpu, const Surface& surface) {
    REQUIRE(device.caps().size() == cpu.caps().size());
    for (std::size_t i = 0; i < cpu.caps().size(); ++i)
        CHECK(device.caps()[i].triangles == cpu.caps()[i].triangles);
    const auto caps = cap_vertices(cpu.caps(), surface.vertex_count());
    const StaircaseParameters staircases{.tau_theta = 0.3, .tau_max = 2.0, .caps = caps};
    const Vec3 axis(0.0, 0.1, 2.0);
    const StaircaseContext found = device.staircases(axis, staircases);
    const StaircaseContext wanted = cpu.staircases(axis, staircases);
    CHECK(found.vertices == wanted.vertices);
    CHECK(largest_difference(found.weights, wanted.weights) <= 1e-6);
    const double size = bounds(surface).diagonal();
    const std::vector<Surface> neighbours{
        icosphere(0.2 * size, 3, bounds(surface).centre() + Vec3(0.4 * size, 0, 0))};
    const DistanceParameters linear{};
    const NeighbourContext far = device.neighbours(neighbours, linear);
    const NeighbourContext far_wanted = cpu.neighbours(neighbours, linear);
    CHECK(far.least == Approx(far_wanted.least).margin(1e-5 * size));
    CHECK(far.most == Approx(far_wanted.most).margin(1e-5 * size));
    CHECK(largest_difference(far.weights, far_wanted.weights) <= 2e-5);
}

}  // namespace

SCENARIO("The device finds the same context as the CPU", "[gpu][context-finder]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        INFO(name);
        compare(*make_gpu_finder(uploaded(*test, surface)), *make_cpu_finder(surface), surface);
    }
    GIVEN("a vessel that the image cuts off in its first slice") {
        const Surface vessel = of_mask(vessel_in_slices());
        const auto cpu = make_cpu_finder(vessel);
        CHECK_FALSE(cpu->caps().empty());
        compare(*make_gpu_finder(uploaded(*test, vessel)), *cpu, vessel);
    }
}

SCENARIO("A finder says when its device is lost, and what makes no sense",
         "[gpu][context-finder]") {
    auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    const auto finder = make_gpu_finder(uploaded(*test, sphere));
    const Vec3 axis = Vec3::UnitZ();
    CHECK_THROWS_AS(finder->staircases(Vec3::Zero(), {}), InvalidInput);
    CHECK_THROWS_AS(finder->staircases(axis, {.tau_max = 0.0}), InvalidInput);
    CHECK_THROWS_AS(finder->neighbours({}, {}), InvalidInput);
    test->device.lost = [] { return true; };
    const auto lost = make_gpu_finder(uploaded(*test, sphere));
    CHECK_THROWS_AS(lost->caps(), GpuUnavailable);
    CHECK_THROWS_AS(lost->staircases(axis, {}), GpuUnavailable);
    CHECK_THROWS_AS(lost->neighbours(std::vector{icosphere(1.0, 2)}, {}), GpuUnavailable);
}
