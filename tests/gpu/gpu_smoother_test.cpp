#include "gpu/gpu_smoother.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr int kIterations = 50;

/// Weights between 0 and 1 that vary along the surface; some are 0, some are 1.
std::vector<double> wavy_weights(const Surface& surface) {
    std::vector<double> weights(surface.vertex_count());
    for (std::size_t v = 0; v < weights.size(); ++v)
        weights[v] = std::clamp(0.5 + 0.7 * std::sin(surface.points()[v].sum()), 0.0, 1.0);
    return weights;
}

Positions on_device(const TestDevice& test, const Surface& surface, const FilterParameters& filter,
                    const FilterSettings& settings) {
    GpuSmoother smoother(uploaded(test, surface), settings);
    smoother.start(filter);
    smoother.run(kIterations);
    return smoother.positions();
}

/// Relative distances between the device's result and the CPU's, ascending.
std::vector<double> differences(const TestDevice& test, const Surface& surface,
                                const FilterParameters& filter, FilterSettings settings) {
    settings.iterations = kIterations;
    return relative_distances(apply_filter(*surface.topology, surface.points(), filter, settings),
                              on_device(test, surface, filter, settings));
}

double at_share(const std::vector<double>& ascending, double share) {
    return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

}  // namespace

SCENARIO("Linear filters on the device agree with the CPU", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const std::vector<std::pair<std::string, FilterParameters>> filters = {
        {"laplace", LaplaceParameters{}},
        {"laplace-hc", LaplaceHcParameters{}},
        {"laplace-hc, pulled to the start", LaplaceHcParameters{0.5, 0.2, 0.6}},
        {"taubin", TaubinParameters{}}};
    for (const auto& [name, surface] : varied_surfaces()) {
        const std::vector<double> weights = wavy_weights(surface);
        for (const auto& [filter_name, filter] : filters) {
            INFO(filter_name << " of " << name);
            CHECK(differences(*test, surface, filter, {}).back() <= 2e-6);
            CHECK(differences(*test, surface, filter, {.weights = weights}).back() <= 2e-6);
        }
        INFO("two rings of " << name);
        CHECK(differences(*test, surface, LaplaceHcParameters{}, {.rings = 2}).back() <= 2e-6);
    }
}

SCENARIO("The node position constraint on the device agrees with the CPU", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces())
        for (const auto cell :
             {PositionConstraint::Cell::Voxel, PositionConstraint::Cell::Diamond}) {
            INFO(name);
            const PositionConstraint constraint{cell, skew_rotation(), Vec3(0.1, 0.2, 0.3)};
            const FilterSettings settings{.constraint = constraint};
            CHECK(differences(*test, surface, LaplaceParameters{}, settings).back() <= 2e-6);
            CHECK(differences(*test, surface, TaubinParameters{}, settings).back() <= 2e-6);
        }
}

SCENARIO("Curvature filters on the device agree with the CPU", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        const std::vector<double> weights = wavy_weights(surface);
        const std::vector<std::pair<std::string, FilterParameters>> filters = {
            {"mean curvature flow", MeanCurvatureFlowParameters{}},
            {"anisotropic", AnisotropicParameters{}},
            {"curvature-triggered", CurvatureTriggeredParameters{}}};
        for (const auto& [filter_name, filter] : filters)
            for (const bool weighted : {false, true}) {
                INFO(filter_name << " of " << name << (weighted ? ", weighted" : ""));
                const auto found =
                    differences(*test, surface, filter,
                                {.weights = weighted ? std::span<const double>(weights)
                                                     : std::span<const double>{}});
                INFO("median " << at_share(found, 0.5) << ", most " << at_share(found, 0.999));
                CHECK(at_share(found, 0.999) <= 1e-5);
                CHECK(found.back() <= 5e-4);
            }
    }
}

SCENARIO("Fixed vertices stay bit for bit on the device", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 10.0, 16, 20);
    std::vector<std::uint8_t> fixed(tube.vertex_count(), 0);
    std::vector<double> weights(tube.vertex_count(), 1.0);
    for (std::size_t v = 0; v < fixed.size(); v += 3) fixed[v] = 1;
    for (std::size_t v = 1; v < fixed.size(); v += 7) weights[v] = 0.0;
    const auto& rim = tube.topology->boundary_vertices();
    const std::vector<FilterParameters> filters = {
        LaplaceParameters{},           LaplaceHcParameters{},   TaubinParameters{},
        MeanCurvatureFlowParameters{}, AnisotropicParameters{}, CurvatureTriggeredParameters{}};
    for (const FilterParameters& filter : filters) {
        INFO("filter " << filter.index());
        const Positions moved =
            on_device(*test, tube, filter, {.weights = weights, .fixed = fixed});
        for (std::size_t v = 0; v < moved.size(); ++v)
            if (fixed[v] != 0 || weights[v] == 0.0 || rim[v] != 0)
                CHECK(moved[v] == tube.points()[v]);
        if (std::holds_alternative<AnisotropicParameters>(filter)) continue;
        const Positions rim_moves = on_device(*test, tube, filter, {.keep_boundary = false});
        CHECK(relative_distances(rim_moves,
                                 apply_filter(*tube.topology, tube.points(), filter,
                                              {.iterations = kIterations, .keep_boundary = false}))
                  .back() <= 1e-5);
    }
}

SCENARIO("A run continues where it stopped, and restarts on request", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    GpuSmoother smoother(uploaded(*test, sphere), {});
    for (const FilterParameters& filter :
         std::vector<FilterParameters>{LaplaceParameters{}, LaplaceHcParameters{}}) {
        smoother.start(filter);
        smoother.run(7);
        const Positions whole = smoother.positions();
        smoother.start(filter);
        CHECK(smoother.positions() == sphere.points());
        for (int i = 0; i < 7; ++i) smoother.run(1);
        CHECK(smoother.positions() == whole);
        CHECK(smoother.iterations_done() == 7);
    }
}

SCENARIO("The device rejects what the CPU rejects", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const auto surface = uploaded(*test, icosphere(5.0, 2));
    GpuSmoother smoother(surface, {});
    CHECK_THROWS_AS(smoother.start(LaplaceParameters{1.5}), InvalidInput);
    CHECK_THROWS_AS(smoother.start(TaubinParameters{0.5, -0.1}), InvalidInput);
    CHECK_THROWS_AS(smoother.start(AnisotropicParameters{0.5, 0.0}), InvalidInput);
    const std::vector<double> two(2, 1.0);
    CHECK_THROWS_AS(GpuSmoother(surface, {.weights = two}), InvalidInput);
    GpuSmoother wide(surface, {.rings = 2});
    CHECK_THROWS_AS(wide.start(MeanCurvatureFlowParameters{}), InvalidInput);
    CHECK_THROWS_AS(DeviceSurface(test->device, Surface{}), InvalidInput);
}

SCENARIO("A copy of a run continues independently", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    for (const FilterParameters& filter : std::vector<FilterParameters>{
             TaubinParameters{}, CurvatureTriggeredParameters{0.5, 0.15}}) {
        GpuSmoother first(uploaded(*test, sphere), {});
        first.start(filter);
        first.run(3);
        GpuSmoother second = first.copy();
        const Positions there = first.positions();
        first.run(4);
        CHECK(second.positions() == there);
        second.run(4);
        CHECK(second.positions() == first.positions());
        CHECK(second.iterations_done() == 7);
    }
}

SCENARIO("Runs with other parameters do not disturb each other", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const Surface noisy = varied_surfaces().front().surface;
    const auto device = uploaded(*test, noisy);
    const std::vector<AnisotropicParameters> filters = {{.feature_curvature = 0.05},
                                                        {.feature_curvature = 5.0}};
    std::vector<Positions> alone;
    for (const AnisotropicParameters& filter : filters) {
        GpuSmoother smoother(device, {});
        smoother.start(filter);
        smoother.run(6);
        alone.push_back(smoother.positions());
    }
    REQUIRE(relative_distances(alone[0], alone[1]).back() > 1e-4);
    GpuSmoother first(device, {}), second(device, {});
    first.start(filters[0]);
    second.start(filters[1]);
    for (int i = 0; i < 2; ++i) {
        first.run(3);
        second.run(3);
    }
    CHECK(first.positions() == alone[0]);
    CHECK(second.positions() == alone[1]);
}

SCENARIO("A second run allocates, compiles and uploads nothing", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    const auto device = uploaded(*test, sphere);
    const GpuSmoother prototype(device, {});
    const Buffer weights =
        GpuSmoother::upload_weights(*device, std::vector<double>(sphere.vertex_count(), 0.5));
    const auto counts_of_run = [&] {
        const DeviceCounts before = *test->device.counts;
        GpuSmoother smoother = prototype.another();
        smoother.set_weights(weights);
        smoother.start(LaplaceParameters{});
        smoother.run(10);
        return since(before, *test->device.counts);
    };
    CHECK(counts_of_run().compiles == 2);
    const DeviceCounts second = counts_of_run();
    CHECK(second.compiles == 0);
    CHECK(second.allocations == 0);
    CHECK(second.uploaded == 0);
    CHECK(second.dispatches == 11);
    CHECK(second.copied == 16 * sphere.vertex_count());
    THEN("another start uses the programs and the connectivity that are there") {
        const Surface larger = mapped(sphere, [](const Vec3& p) { return Vec3(1.1 * p); });
        const DeviceCounts before = *test->device.counts;
        GpuSmoother smoother(uploaded(*test, sphere.with_positions(larger.points())), {});
        smoother.start(LaplaceParameters{});
        smoother.run(10);
        const DeviceCounts counts = since(before, *test->device.counts);
        CHECK(counts.compiles == 0);
        CHECK(counts.uploaded == 4 * 16 * sphere.vertex_count());  // positions and umbrellas
    }
}

SCENARIO("Corners follow each other around a vertex", "[gpu][smoother]") {
    const auto test = test_device();
    if (!test) return;
    for (const Surface& surface : {icosphere(5.0, 3), open_tube(2.0, 10.0, 16, 20)}) {
        const auto device = uploaded(*test, surface);
        const auto& rows = surface.topology->triangles_at();
        const auto corners = read_storage<std::array<VertexId, 2>>(
            test->device, device->corners().values.buffer, rows.values.size());
        std::size_t breaks = 0;
        for (std::size_t v = 0; v < surface.vertex_count(); ++v)
            for (std::uint32_t i = rows.offsets[v] + 1; i < rows.offsets[v + 1]; ++i)
                breaks += corners[i][0] != corners[i - 1][1] ? 1 : 0;
        CHECK(breaks == 0);
    }
}
