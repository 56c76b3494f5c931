#include "gpu/device_neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>
#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "gpu/gpu_weights.h"
#include "smoothing/context/distance_weights.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Largest difference from the CPU's distances, over the diagonal of the surface.
double largest_difference(const TestDevice& test, const Surface& surface,
                          const std::vector<Surface>& neighbours) {
    const auto wanted = neighbour_distances(surface.points(), neighbours);
    const auto device = uploaded(test, surface);
    const NeighbourDistances found = find_neighbour_distances(*device, neighbours);
    const auto distances = read_vertices<float>(*device, found.distances);
    double largest = 0.0;
    for (std::size_t v = 0; v < wanted.size(); ++v)
        largest = std::max(largest, std::abs(distances[v] - wanted[v]));
    CHECK(found.least == *std::ranges::min_element(distances));
    CHECK(found.most == *std::ranges::max_element(distances));
    return largest / bounds(surface).diagonal();
}

Surface moved(const Surface& surface, const Vec3& way) {
    return mapped(surface, [&](const Vec3& p) { return Vec3(p + way); });
}

}  // namespace

SCENARIO("Distances to neighbours on the device are the CPU's", "[gpu][neighbours]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 30.0, 40, 60), ball = icosphere(4.0, 3, Vec3(6, 0, 10));
    GIVEN("an open neighbour, a closed one that reaches inside, one far away") {
        CHECK(largest_difference(*test, tube, {moved(tube, Vec3(5, 1, 0))}) < 1e-6);
        CHECK(largest_difference(*test, tube, {ball}) < 1e-6);
        CHECK(largest_difference(*test, tube, {moved(ball, Vec3(400, 0, 0))}) < 1e-5);
        CHECK(largest_difference(*test, tube, {ball, moved(ball, Vec3(-9, 0, 3)), cube(1.0)}) <
              1e-6);
    }
    GIVEN("all vertices inside, or on the neighbour itself") {
        CHECK(largest_difference(*test, icosphere(1.0, 3), {icosphere(2.0, 2)}) == 0.0);
        CHECK(largest_difference(*test, ball, {ball}) < 1e-6);
    }
    GIVEN("a closed neighbour with a hollow, in which the surface is outside") {
        Surface hollow = icosphere(2.0, 3);
        std::vector<Triangle> turned;
        for (const auto& [a, b, c] : hollow.triangles()) turned.push_back({a, c, b});
        hollow = merged(icosphere(3.0, 3), make_surface(hollow.points(), std::move(turned)));
        CHECK(largest_difference(*test, icosphere(1.0, 3), {hollow}) < 1e-6);
        CHECK(largest_difference(*test, icosphere(2.5, 3), {hollow}) == 0.0);
    }
    GIVEN("real surfaces beside each other") {
        for (const auto& [name, surface] : varied_surfaces()) {
            INFO(name);
            const Bounds box = bounds(surface);
            const Vec3 beside(0.4 * (box.max - box.min).x(), 0.1, -0.2);
            CHECK(largest_difference(*test, surface, {moved(surface, beside)}) < 1e-5);
        }
    }
}

SCENARIO("Weights from distances that never left the device are the CPU's", "[gpu][neighbours]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 30.0, 40, 60);
    const std::vector<Surface> neighbours{icosphere(4.0, 3, Vec3(6, 0, 10))};
    const auto distances = neighbour_distances(tube.points(), neighbours);
    const auto device = uploaded(*test, tube);
    const NeighbourDistances found = find_neighbour_distances(*device, neighbours);
    GpuWeights weights(device);
    for (const auto scaling :
         {DistanceScaling::Linear, DistanceScaling::Margin, DistanceScaling::Exponential}) {
        weights.restart();
        weights.multiply_distances(found, {.scaling = scaling});
        const auto wanted = distance_weights(distances, {.scaling = scaling});
        const auto made = read_vertices<float>(*device, weights.weights());
        for (std::size_t v = 0; v < wanted.size(); ++v)
            CHECK(made[v] == Approx(wanted[v]).margin(1e-5));
    }
}

SCENARIO("A failing search for neighbours reports it", "[gpu][neighbours]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    const auto surface = uploaded(*test, sphere);
    CHECK_THROWS_AS(find_neighbour_distances(*surface, {}), InvalidInput);
    const std::vector<Surface> nothing{Surface{}};
    CHECK_THROWS_AS(find_neighbour_distances(*surface, nothing), InvalidInput);
    const std::vector<Surface> neighbours{sphere};
    Device dying = current_device();
    dying.lost = [] { return true; };
    CHECK_THROWS_AS(find_neighbour_distances(DeviceSurface(dying, sphere), neighbours),
                    GpuUnavailable);
    Device small = test->device;
    small.limits.largest_storage_block = 48 * sphere.triangle_count() - 1;
    small.limits.largest_view = 100;
    CHECK_THROWS_WITH(find_neighbour_distances(DeviceSurface(small, sphere), neighbours),
                      Catch::Contains("a neighbour's"));
}

SCENARIO("A search in a damaged tree ends", "[gpu][neighbours]") {
    const auto test = test_device();
    if (!test) return;
    const Device& device = test->device;
    const std::size_t count = 100;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto filled = [&](std::size_t floats, float value) {
        const std::vector<float> all(floats, value);
        return make_storage(device, std::span<const float>(all), "numbers");
    };

    // two inner nodes that name each other, a leaf of 2^31 - 1 triangles, one that names no node
    struct Node {
        float low[3];
        std::uint32_t begin;
        float high[3];
        std::uint32_t right;
    };

    const auto node = [](std::uint32_t right) { return Node{{-9, -9, -9}, 0, {9, 9, 9}, right}; };
    const std::vector<Node> nodes{node(0), node(0), node(0xffffffff), node(0x7ffffff0)};
    const Buffer tree = make_storage(device, std::span<const Node>(nodes), "nodes");
    const Program program = make_compute_program(device, "neighbour_distance");
    for (const float position : {0.5F, nan})
        for (const float corner : {1.0F, nan}) {
            const Buffer shifts = filled(4 * count, position), anchors = filled(4 * count, 0.0F),
                         corners = filled(4 * 3 * 4, corner), dipoles = filled(8 * 4, nan),
                         distances = filled(count, 3.1e38F);
            bind_storage({&shifts, &distances, nullptr, &tree, &corners, &dipoles, &anchors});
            glUseProgram(program.id());
            glUniform1i(1, 1);
            glUniform1f(2, 2.0F);
            dispatch(device, program, count);
            const auto found = read_storage<float>(device, distances, count);
            CHECK(std::ranges::all_of(found, [&](float d) { return d == found.front(); }));
            if (std::isnan(position)) CHECK(found.front() == 3.1e38F);
        }
}
