// The order of vertices on the device: surfaces numbered at random have the same results.

#include "gpu/device_order.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/measure.h"
#include "gpu/device_caps.h"
#include "gpu/device_neighbours.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "gpu/gpu_weights.h"
#include "gpu/render/drawn_device_surface.h"
#include "tests/gpu/device_support.h"
#include "tests/gpu/render_support.h"
#include "tests/support/shapes.h"
#include "tests/support/shuffled.h"
#include "tests/support/stack_phantoms.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const Vec3 kAxis(0.1, 0.0, 1.0);

/// Vessels with caps and staircases, and an open tube with noise.
std::vector<Surface> surfaces() {
    Surface vessels = of_mask(vessel_in_slices());
    while (vessels.vertex_count() < 5000) {
        const double across = bounds(vessels).diagonal();
        vessels = merged(vessels, mapped(vessels, [&](const Vec3& p) {
                             return Vec3(p + Vec3(across, 0.0, 0.0));
                         }));
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.05, 0.05);
    return {vessels, mapped(open_tube(2.0, 30.0, 60, 100), [&](const Vec3& p) {
                return Vec3(p + Vec3(noise(random), noise(random), noise(random)));
            })};
}

/// A surface, the same one numbered at random, and both on the device.
struct Pair {
    Surface usual, mixed;
    std::vector<VertexId> numbers;  ///< usual to mixed
    std::shared_ptr<const DeviceSurface> usual_there, mixed_there;

    Pair(const TestDevice& test, const Surface& surface) : usual(surface) {
        mixed = shuffled(usual, numbers);
        usual_there = uploaded(test, usual);
        mixed_there = uploaded(test, mixed);
        REQUIRE_FALSE(mixed_there->order().is_own());
    }

    template <class T>
    [[nodiscard]] std::vector<T> to_mixed(const std::vector<T>& usual_values) const {
        std::vector<T> values(usual_values.size());
        for (std::size_t v = 0; v < values.size(); ++v) values[numbers[v]] = usual_values[v];
        return values;
    }
};

template <class T>
double largest_difference(const std::vector<T>& a, const std::vector<T>& b) {
    double largest = a.size() == b.size() ? 0.0 : 1e9;
    for (std::size_t v = 0; v < a.size(); ++v)
        largest = std::max<double>(largest, std::abs(a[v] - b[v]));
    return largest;
}

void check_close(const QualityMeasures& a, const QualityMeasures& b) {
    CHECK(a.error == Approx(b.error).epsilon(1e-4));
    CHECK(a.error_thesis == Approx(b.error_thesis).epsilon(1e-4));
    CHECK(a.curvature == Approx(b.curvature).epsilon(1e-4).margin(1e-4 * b.curvature_abs));
    CHECK(a.curvature_abs == Approx(b.curvature_abs).epsilon(1e-4));
    CHECK(a.volume == Approx(b.volume).epsilon(1e-5));
}

}  // namespace

SCENARIO("A numbering that follows the mesh stays, another one is made to", "[gpu][order]") {
    const Surface tube = open_tube(2.0, 30.0, 60, 100);
    CHECK(DeviceOrder(*tube.topology).is_own());
    std::vector<VertexId> numbers;
    const Surface mixed = shuffled(tube, numbers);
    const DeviceOrder order(*mixed.topology);
    REQUIRE_FALSE(order.is_own());
    std::size_t band = 0, wrong = 0;
    for (VertexId place = 0; place < mixed.vertex_count(); ++place) {
        const VertexId v = order.vertex_at(place);
        wrong += order.place_of(v) != place ? 1 : 0;
        for (const VertexId u : mixed.topology->rings().row(v))
            band = std::max<std::size_t>(
                band, std::max(order.place_of(u), place) - std::min(order.place_of(u), place));
    }
    CHECK(wrong == 0);
    CHECK(band < 200);
    CHECK(order.by_vertex(order.by_place(numbers)) == numbers);
}

SCENARIO("A surface numbered at random is smoothed and measured alike", "[gpu][order]") {
    const auto test = test_device();
    if (!test) return;
    const std::vector<FilterParameters> filters = {
        LaplaceHcParameters{}, MeanCurvatureFlowParameters{}, AnisotropicParameters{},
        CurvatureTriggeredParameters{}};
    for (const Surface& surface : surfaces()) {
        const Pair pair(*test, surface);
        std::vector<std::uint8_t> fixed(surface.vertex_count());
        std::vector<double> weights(surface.vertex_count());
        for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
            fixed[v] = v % 50 == 0 ? 1 : 0;
            weights[v] = 0.5 + 0.5 * std::sin(0.01 * static_cast<double>(v));
        }
        const auto mixed_fixed = pair.to_mixed(fixed);
        const auto mixed_weights = pair.to_mixed(weights);
        const PositionConstraint constraint{PositionConstraint::Cell::Voxel,
                                            Eigen::Matrix3d::Identity(), Vec3(1, 1, 3)};
        const auto found = [&](const std::shared_ptr<const DeviceSurface>& there,
                               const FilterParameters& filter, const FilterSettings& settings) {
            GpuSmoother smoother(there, settings);
            GpuMeter meter(there, 1, true);
            smoother.start(filter);
            smoother.run(10);
            meter.measure(smoother.shifts());
            return std::pair(smoother.positions(), meter.read().front());
        };
        const auto compare = [&](const FilterParameters& filter, int rings) {
            CAPTURE(filter.index(), rings);
            const auto usual = found(
                pair.usual_there, filter,
                {.weights = weights, .fixed = fixed, .rings = rings, .constraint = constraint});
            const auto other = found(pair.mixed_there, filter,
                                     {.weights = mixed_weights,
                                      .fixed = mixed_fixed,
                                      .rings = rings,
                                      .constraint = constraint});
            CHECK(relative_distances(pair.to_mixed(usual.first), other.first).back() <= 2e-6);
            check_close(other.second.quality, usual.second.quality);
            CHECK(other.second.largest_error == Approx(usual.second.largest_error).epsilon(1e-3));
        };
        for (const FilterParameters& filter : filters) compare(filter, 1);
        compare(LaplaceParameters{}, 2);
    }
}

SCENARIO("A surface numbered at random has the same context", "[gpu][order]") {
    const auto test = test_device();
    if (!test) return;
    const Surface vessel = surfaces().front();
    const Pair pair(*test, vessel);
    THEN("the caps are those the CPU finds, in its order") {
        const auto wanted = find_caps(pair.mixed), found = find_caps(*pair.mixed_there);
        REQUIRE(wanted.size() >= 2);
        REQUIRE(found.size() == wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CHECK(found[i].triangles == wanted[i].triangles);
            CHECK(found[i].rim == wanted[i].rim);
        }
    }
    THEN("staircases and their weights are the same") {
        const auto weights_of = [&](const std::shared_ptr<const DeviceSurface>& there,
                                    const std::vector<std::uint8_t>& caps) {
            GpuWeights weights(there);
            weights.find_orientation_change(kAxis);
            weights.multiply_staircases({.tau_theta = 0.3, .tau_max = 4.0, .caps = caps});
            CHECK(weights.staircase_vertices() > 0);
            return std::pair(weights.orientation_change(),
                             read_vertices<float>(*there, weights.weights()));
        };
        const auto caps = cap_vertices(find_caps(vessel), vessel.vertex_count());
        const auto usual = weights_of(pair.usual_there, caps);
        const auto mixed = weights_of(pair.mixed_there, pair.to_mixed(caps));
        CHECK(largest_difference(pair.to_mixed(usual.first), mixed.first) < 1e-9);
        CHECK(largest_difference(pair.to_mixed(usual.second), mixed.second) < 1e-6);
    }
    THEN("so are distances to a neighbour") {
        const std::vector<Surface> neighbours{
            mapped(vessel, [](const Vec3& p) { return Vec3(p + Vec3(4.0, 1.0, 0.0)); })};
        const auto distances = [&](const std::shared_ptr<const DeviceSurface>& there) {
            const auto found = find_neighbour_distances(*there, neighbours);
            return read_vertices<float>(*there, found.distances);
        };
        CHECK(pair.to_mixed(distances(pair.usual_there)) == distances(pair.mixed_there));
    }
}

SCENARIO("A surface numbered at random is drawn alike from the device", "[gpu][order]") {
    const auto test = render_test(160);
    if (!test) return;
    const Surface tube = surfaces().back();
    std::vector<VertexId> numbers;
    const Surface mixed = shuffled(tube, numbers);
    const Device device = current_device();
    const auto picture = [&](const Surface& surface, Edges edges) {
        const auto there = std::make_shared<const DeviceSurface>(device, surface);
        GpuMeter meter(there);
        meter.measure(there->shifts());
        const auto source = std::make_shared<DrawnDeviceSurface>(there);
        source->show({&there->shifts(), &meter.normals(), nullptr});
        SurfaceLayer layer{.source = source};
        layer.edges = edges;
        SceneView view;
        view.camera = framed(facing({}, StandardView::Anterior), bounds(surface), 1.0);
        return test->picture(view, {.surfaces = {layer}});
    };
    const Picture plain = picture(tube, Edges::Off), over = picture(tube, Edges::Over);
    CHECK(covered_pixels(plain) > 500);
    CHECK(brightness(over) < brightness(plain) - 0.5);
    CHECK(vesselbench::test::largest_difference(plain, picture(mixed, Edges::Off)) < 12);
    // a line from its other end may pass one pixel beside
    CHECK(brightness(picture(mixed, Edges::Over)) == Approx(brightness(over)).margin(0.1));
}
