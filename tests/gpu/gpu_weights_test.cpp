#include "gpu/gpu_weights.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/gpu_smoother.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/staircases.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const Vec3 kAxis(0.3, -0.2, 2.0);

double largest_difference(const DeviceSurface& surface, const Buffer& weights,
                          const std::vector<double>& wanted) {
    const auto found = read_vertices<float>(surface, weights);
    double largest = 0.0;
    for (std::size_t v = 0; v < wanted.size(); ++v)
        largest = std::max(largest, std::abs(found[v] - wanted[v]));
    return largest;
}

std::vector<double> distances_to_plane(const Surface& surface) {
    std::vector<double> distances;
    for (const Vec3& p : surface.points()) distances.push_back(std::abs(p.x() - 90.0));
    return distances;
}

}  // namespace

SCENARIO("The device detects the same staircases as the CPU", "[gpu][weights]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        INFO(name);
        GpuWeights weights(uploaded(*test, surface));
        weights.find_orientation_change(kAxis);
        const auto found = weights.orientation_change();
        const auto wanted = orientation_change(*surface.topology, surface.points(), kAxis);
        for (const double tau_theta : {0.05, 0.2, 0.7}) {
            std::size_t others = 0;
            for (std::size_t v = 0; v < found.size(); ++v) {
                if ((found[v] > tau_theta) == (wanted[v] > tau_theta)) continue;
                ++others;
                CHECK(std::abs(wanted[v] - tau_theta) <= 1e-5);
            }
            CHECK(others <= found.size() / 1000);
        }
        for (std::size_t v = 0; v < found.size(); ++v)
            if (std::abs(found[v] - wanted[v]) > 1e-9) CHECK(found[v] == wanted[v]);
    }
}

SCENARIO("Staircase weights on the device are the CPU's, caps left out", "[gpu][weights]") {
    const auto test = test_device();
    if (!test) return;
    const auto surfaces = varied_surfaces();
    const Surface& surface = surfaces.back().surface;
    const auto caps = cap_vertices({}, surface.vertex_count());
    std::vector<std::uint8_t> some_caps = caps;
    for (std::size_t v = 0; v < some_caps.size(); v += 11) some_caps[v] = 1;
    const auto device = uploaded(*test, surface);
    GpuWeights weights(device);
    weights.find_orientation_change(kAxis);
    const auto change = orientation_change(*surface.topology, surface.points(), kAxis);
    for (const auto scaling : {StaircaseScaling::TauMax, StaircaseScaling::Thesis})
        for (const double beta_min : {0.0, 0.3})
            for (const double tau_theta : {0.1, 0.3, 2.0 / 3.0}) {
                const StaircaseParameters parameters{.tau_theta = tau_theta,
                                                     .tau_max = 4.0,
                                                     .beta_min = beta_min,
                                                     .scaling = scaling,
                                                     .caps = some_caps};
                weights.restart();
                weights.multiply_staircases(parameters);
                CHECK(largest_difference(*device, weights.weights(),
                                         staircase_weights(*surface.topology, surface.points(),
                                                           change, parameters)) <= 1e-6);
            }
}

SCENARIO("A failed search leaves the previous weights unchanged", "[gpu][weights]") {
    auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 30.0, 40, 60);
    bool full = false;
    test->device.fails = [&](DeviceCommand command) {
        return full && command == DeviceCommand::Allocate;
    };
    GpuWeights weights(uploaded(*test, tube));
    weights.find_orientation_change(kAxis);
    const StaircaseParameters parameters{.tau_theta = 0.01, .tau_max = 1.0};
    weights.multiply_staircases(parameters);
    const auto before = read_storage<float>(test->device, weights.weights(), tube.vertex_count());
    const std::vector<std::uint8_t> caps(tube.vertex_count(), 1);
    full = true;
    CHECK_THROWS_AS(weights.multiply_staircases({.caps = caps}), GpuUnavailable);
    full = false;
    weights.restart();
    weights.multiply_staircases(parameters);
    CHECK(read_storage<float>(test->device, weights.weights(), tube.vertex_count()) == before);
    CHECK(std::ranges::max(before) > 0.5F);
}

SCENARIO("Distance weights on the device are the CPU's", "[gpu][weights]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = varied_surfaces().front().surface;
    const auto distances = distances_to_plane(sphere);
    const auto [least, most] = std::ranges::minmax(distances);
    const std::vector<float> single(distances.begin(), distances.end());
    const auto device = uploaded(*test, sphere);
    const NeighbourDistances known{make_vertices(*device, single, "distances"), least, most,
                                   distances.size()};
    GpuWeights weights(device);
    for (const auto scaling :
         {DistanceScaling::Linear, DistanceScaling::Margin, DistanceScaling::Exponential})
        for (const double omega : {0.06, 3.0}) {
            const DistanceParameters parameters{.scaling = scaling, .margin = 4.0, .omega = omega};
            weights.restart();
            weights.multiply_distances(known, parameters);
            CHECK(largest_difference(*device, weights.weights(),
                                     distance_weights(distances, parameters)) <= 1e-5);
        }
    THEN("a margin that nothing exceeds leaves nothing to move") {
        weights.restart();
        weights.multiply_distances(known, {.scaling = DistanceScaling::Margin, .margin = 500.0});
        CHECK(largest_difference(*device, weights.weights(),
                                 std::vector<double>(distances.size(), 0.0)) == 0.0);
    }
    CHECK_THROWS_AS(weights.multiply_distances(known, {.omega = 0.0}), InvalidInput);
    CHECK_THROWS_AS(GpuWeights(uploaded(*test, icosphere(1.0, 2))).multiply_distances(known),
                    InvalidInput);
    CHECK_THROWS_AS(weights.multiply_distances(known, {.margin = -1.0}), InvalidInput);
    CHECK_THROWS_AS(weights.find_orientation_change(Vec3::Zero()), InvalidInput);
}

SCENARIO("Weights made on the device smooth as the CPU's do", "[gpu][weights]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = varied_surfaces()[1].surface;
    const auto device = uploaded(*test, tube);
    const StaircaseParameters parameters{.tau_theta = 0.01, .tau_max = 1.0, .beta_min = 0.2};
    GpuWeights weights(device);
    weights.find_orientation_change(kAxis);
    weights.multiply_staircases(parameters);
    GpuSmoother smoother(device, {});
    smoother.set_weights(weights.weights());
    smoother.start(LaplaceParameters{});
    smoother.run(50);
    const auto on_cpu =
        staircase_weights(*tube.topology, tube.points(),
                          orientation_change(*tube.topology, tube.points(), kAxis), parameters);
    const Positions wanted = apply_filter(*tube.topology, tube.points(), LaplaceParameters{},
                                          {.iterations = 50, .weights = on_cpu});
    CHECK(relative_distances(wanted, smoother.positions()).back() <= 2e-6);
    CHECK(relative_distances(tube.points(), wanted).back() > 1e-4);
}
