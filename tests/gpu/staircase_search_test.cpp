#include "gpu/staircase_search.h"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/scan.h"
#include "smoothing/context/connected_distances.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

std::vector<double> some_changes(std::size_t count, double share) {
    std::mt19937 random(11);
    std::bernoulli_distribution chosen(share);
    std::vector<double> changes(count);
    for (double& change : changes) change = chosen(random) ? 1.0 : 0.0;
    return changes;
}

/// The device's result, and the number of vertices it left to the CPU.
struct OnDevice {
    std::vector<float> distances;
    double farthest;
    std::size_t open;
};

OnDevice search(const std::shared_ptr<const DeviceSurface>& surface,
                const std::vector<double>& changes, double tau_theta, double tau_max) {
    const Device& device = surface->device();
    const std::vector<float> ones(changes.size(), 1.0F);
    const DeviceDistances found = search_staircases(
        *surface, make_vertices(*surface, changes, "changes"),
        make_storage(device, std::span<const float>(ones), "ones"), tau_theta, tau_max);
    return {read_vertices<float>(*surface, found.distances), found.farthest, found.open};
}

/// Vertices whose distances are not the CPU's, rounded to single precision.
std::size_t differing(const OnDevice& found, const std::vector<double>& wanted) {
    std::size_t others = 0;
    double farthest = 0.0;
    for (std::size_t v = 0; v < wanted.size(); ++v) {
        const bool reached = std::isfinite(wanted[v]);
        if (reached) farthest = std::max(farthest, wanted[v]);
        const bool same = reached ? std::abs(found.distances[v] - wanted[v]) <= 1e-6 * wanted[v]
                                  : found.distances[v] > 3e38F;
        others += same ? 0 : 1;
    }
    CHECK(found.farthest == Approx(farthest).epsilon(1e-6));
    return others;
}

/// A sphere with another one inside, 0.6 mm below it, and spikes that no straight walk climbs.
Surface spiky_shells() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> height(-1.0, 1.0);
    return mapped(merged(icosphere(5.0, 4), icosphere(4.4, 4)),
                  [&](const Vec3& p) { return Vec3(p * (1.0 + 0.15 * height(random))); });
}

/// One sheet, folded so that its halves lie 0.3 mm above each other.
Surface folded_sheet() {
    return mapped(open_tube(2.0, 30.0, 60, 100), [](const Vec3& p) {
        const double along = std::abs(p.z() - 15.0);
        return Vec3(5.0 * std::atan2(p.y(), p.x()), along, p.z() < 15.0 ? 0.0 : 0.3);
    });
}

}  // namespace

SCENARIO("Numbers are added up on the device", "[gpu][scan]") {
    const auto test = test_device();
    if (!test) return;
    const auto surface = uploaded(*test, icosphere(1.0, 1));
    for (const std::size_t count : {1, 2, 1023, 1024, 1025, 70'000, 1'100'000}) {
        std::vector<std::uint32_t> numbers(count);
        for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i * i % 7);
        const Buffer buffer =
            make_storage(test->device, std::span<const std::uint32_t>(numbers), "numbers");
        add_up(*surface, buffer, count);
        for (std::size_t i = 1; i < count; ++i) numbers[i] += numbers[i - 1];
        CHECK(read_storage<std::uint32_t>(test->device, buffer, count) == numbers);
    }
}

SCENARIO("The device finds the same distances along a surface as the CPU",
         "[gpu][staircase-search]") {
    const auto test = test_device();
    if (!test) return;
    const Surface far = mapped(icosphere(5.0, 1), [](const Vec3& p) { return Vec3(p * 1e5); });
    const std::vector<NamedSurface> surfaces{
        {"sphere", icosphere(5.0, 4)},
        {"shells", spiky_shells()},
        {"fold", folded_sheet()},
        {"crowd", merged(icosphere(5.0, 3), far)},
        {"plane", mapped(icosphere(5.0, 3), [](const Vec3& p) { return Vec3(p.x(), p.y(), 0); })},
        {"point", mapped(icosphere(5.0, 2), [](const Vec3&) { return Vec3(1, 2, 3); })}};
    for (const auto& [name, surface] : surfaces)
        for (const double share : {0.0, 0.005, 0.1, 1.0})
            for (const double reach : {0.3, 2.5, 100.0}) {
                CAPTURE(name, share, reach);
                const auto changes = some_changes(surface.vertex_count(), share);
                const auto wanted = staircase_distances(*surface.topology, surface.points(),
                                                        changes, {.tau_max = reach});
                const OnDevice found = search(uploaded(*test, surface), changes, 0.7, reach);
                CHECK(differing(found, wanted) == 0);
                if (name == "sphere") CHECK(found.open == 0);
            }
}

SCENARIO("Vertices left open by a search get the distances of a complete one",
         "[gpu][staircase-search]") {
    const Surface surface = spiky_shells();
    const Topology& topology = *surface.topology;
    std::vector<VertexId> sources;
    for (VertexId v = 0; v < surface.vertex_count(); v += 9) sources.push_back(v);
    const auto wanted = connected_distances(topology, surface.points(), sources, 1.5);
    std::vector<OpenVertex> open;
    for (VertexId v = 1; v < surface.vertex_count(); v += 9) open.push_back({.vertex = v});
    const auto all = open_distances(topology, surface.points(), sources, 1.5, open);
    for (std::size_t i = 0; i < open.size(); ++i) CHECK(all[i] == wanted[open[i].vertex]);
    for (auto& vertex : open) vertex.known = sources.back();  // everything is within that reach
    const auto far = connected_distances(topology, surface.points(), sources, 100.0);
    const auto bounded = open_distances(topology, surface.points(), sources, 100.0, open);
    for (std::size_t i = 0; i < open.size(); ++i)
        if (open[i].vertex >= surface.vertex_count() / 2)  // the part of the last source
            CHECK(bounded[i] == far[open[i].vertex]);
    CHECK(open_distances(topology, surface.points(), {}, 1.5, open) ==
          std::vector<double>(open.size(), std::numeric_limits<double>::infinity()));
}

SCENARIO("Staircases of image stacks and raw surfaces have the same reach on the device",
         "[gpu][staircase-search]") {
    const auto test = test_device();
    if (!test) return;
    std::vector<NamedSurface> surfaces = varied_surfaces();
    surfaces.push_back({"vessel in slices", of_mask(vessel_in_slices())});
    surfaces.push_back({"organ in slices", imaged(organ_in_slices())});
    for (const auto& [name, surface] : surfaces) {
        const auto changes =
            orientation_change(*surface.topology, surface.points(), Vec3(0.1, 0.0, 1.0));
        const auto on_device = uploaded(*test, surface);
        for (const double tau_theta : {0.2, 0.7})
            for (const double tau_max : {1.0, 3.0, 6.0}) {
                const auto wanted =
                    staircase_distances(*surface.topology, surface.points(), changes,
                                        {.tau_theta = tau_theta, .tau_max = tau_max});
                const OnDevice found = search(on_device, changes, tau_theta, tau_max);
                CAPTURE(name, tau_theta, tau_max, found.open);
                CHECK(differing(found, wanted) == 0);
                CHECK(found.open <= surface.vertex_count() / 4);
            }
    }
}

SCENARIO("A search for staircases reports a lost context", "[gpu][staircase-search]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    Device dying = current_device();
    int looks = GENERATE(0, 1, 2);
    dying.lost = [&looks] { return looks-- <= 0; };
    const auto surface = std::make_shared<const DeviceSurface>(dying, sphere);
    const auto changes = some_changes(sphere.vertex_count(), 0.1);
    CHECK_THROWS_AS(search(surface, changes, 0.5, 1.0), GpuUnavailable);
    Device small = test->device;
    small.limits.largest_storage_block = 20 * sphere.vertex_count();
    small.limits.largest_view = 100;
    const auto narrow = std::make_shared<const DeviceSurface>(small, sphere);
    CHECK_THROWS_WITH(search(narrow, changes, 0.5, 1.0), Catch::Contains("the device allows"));
}
