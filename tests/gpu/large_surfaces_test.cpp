// Surfaces whose tables exceed a storage block of the device: read through textures, they give the
// same results.

#include <catch2/catch.hpp>

#include "gpu/device_caps.h"
#include "gpu/device_neighbours.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "gpu/gpu_weights.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// The surface on a device whose blocks hold so many bytes a vertex.
std::shared_ptr<const DeviceSurface> in_blocks(const TestDevice& test, const Surface& surface,
                                               std::size_t bytes) {
    Device small = test.device;
    small.limits.largest_storage_block = bytes * surface.vertex_count();
    return std::make_shared<const DeviceSurface>(small, surface);
}

constexpr std::size_t kLeast = 16;  // a vec4

Positions smoothed(const std::shared_ptr<const DeviceSurface>& surface,
                   const FilterParameters& filter, int rings) {
    GpuSmoother smoother(surface, {.rings = rings});
    smoother.start(filter);
    smoother.run(5);
    return smoother.positions();
}

std::vector<Surface> shapes() {
    return {varied_surfaces().front().surface, open_tube(2.0, 30.0, 40, 60)};
}

}  // namespace

SCENARIO("A surface too large for storage blocks is smoothed alike", "[gpu][large]") {
    const auto test = test_device();
    if (!test) return;
    const std::vector<FilterParameters> filters = {
        LaplaceHcParameters{}, MeanCurvatureFlowParameters{}, AnisotropicParameters{},
        CurvatureTriggeredParameters{}};
    for (const Surface& surface : shapes()) {
        const auto usual = uploaded(*test, surface), large = in_blocks(*test, surface, kLeast);
        REQUIRE(large->wide());
        REQUIRE_FALSE(usual->wide());
        for (const FilterParameters& filter : filters) {
            INFO("filter " << filter.index());
            CHECK(smoothed(large, filter, 1) == smoothed(usual, filter, 1));
        }
        CHECK(smoothed(large, LaplaceParameters{}, 2) == smoothed(usual, LaplaceParameters{}, 2));
        const auto middle = in_blocks(*test, surface, 50);  // only its rings of two are too large
        CHECK_FALSE(middle->wide());
        CHECK(middle->rings(2).values.wide());
        CHECK(smoothed(middle, LaplaceParameters{}, 2) == smoothed(usual, LaplaceParameters{}, 2));
    }
}

SCENARIO("A surface too large for storage blocks is measured and weighted alike", "[gpu][large]") {
    const auto test = test_device();
    if (!test) return;
    for (const Surface& surface : shapes()) {
        const auto found = [&](const std::shared_ptr<const DeviceSurface>& device) {
            GpuSmoother smoother(device, {});
            smoother.start(LaplaceParameters{});
            smoother.run(10);
            GpuMeter meter(device, 1, true);
            meter.measure(smoother.shifts());
            GpuWeights weights(device);
            weights.find_orientation_change(Vec3(0.3, -0.2, 2.0));
            weights.multiply_staircases({.tau_theta = 0.05, .tau_max = 1.0, .beta_min = 0.2});
            return std::tuple(
                meter.read().front().quality, weights.orientation_change(),
                read_storage<float>(device->device(), weights.weights(), surface.vertex_count()));
        };
        CHECK(found(in_blocks(*test, surface, kLeast)) == found(uploaded(*test, surface)));
    }
}

SCENARIO("Caps and neighbours of a surface too large for storage blocks are found alike",
         "[gpu][large]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = closed_tube(3.0, 20.0, 48, 60);
    const auto usual = uploaded(*test, tube), large = in_blocks(*test, tube, kLeast);
    const auto wanted = find_caps(*usual), found = find_caps(*large);
    REQUIRE(wanted.size() == 2);
    REQUIRE(found.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) CHECK(found[i].triangles == wanted[i].triangles);
    const std::vector<Surface> neighbours{icosphere(4.0, 4, Vec3(6, 0, 10))};
    const auto distances = [&](const std::shared_ptr<const DeviceSurface>& device) {
        const NeighbourDistances all = find_neighbour_distances(*device, neighbours);
        return read_storage<float>(device->device(), all.distances, all.count);
    };
    CHECK(distances(large) == distances(usual));
}
