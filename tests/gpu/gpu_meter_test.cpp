#include "gpu/gpu_meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/local_error.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "gpu/gpu_smoother.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// The CPU's measures of a state, its error against `original`.
DeviceMeasures on_cpu(const Surface& original, const Positions& moved) {
    const SurfaceMeter meter(original.topology, original.positions, true);
    std::vector<PackRow> packs(moved.size());
    for (std::size_t v = 0; v < packs.size(); ++v)
        packs[v] = {{moved[v].x(), moved[v].y(), moved[v].z(), 0.0}};
    auto references = meter.own_references();
    return {meter.follow_and_measure(packs, references),
            local_error(*original.topology, original.points(), moved).largest};
}

void check_close(const char* what, double device, double cpu, double diagonal) {
    INFO(what << ": " << device << " on the device, " << cpu << " on the CPU");
    CHECK(std::abs(device - cpu) <= std::max(1e-4 * std::abs(cpu), 1e-6 * diagonal));
}

void check_all(const DeviceMeasures& device, const DeviceMeasures& cpu, double diagonal) {
    check_close("error", device.quality.error, cpu.quality.error, diagonal);
    check_close("largest error", device.largest_error, cpu.largest_error, diagonal);
    check_close("error of the thesis", device.quality.error_thesis, cpu.quality.error_thesis,
                diagonal);
    check_close("curvature", device.quality.curvature, cpu.quality.curvature, diagonal);
    check_close("absolute curvature", device.quality.curvature_abs, cpu.quality.curvature_abs,
                diagonal);
    check_close("volume", device.quality.volume, cpu.quality.volume, 0.0);
}

}  // namespace

SCENARIO("Measures on the device agree with the CPU's", "[gpu][meter]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        const auto device = uploaded(*test, surface);
        GpuSmoother smoother(device, {});
        GpuMeter meter(device, 1, true);
        for (const int iterations : {0, 1, 20}) {
            INFO(name << " after " << iterations << " iterations");
            smoother.start(LaplaceParameters{});
            smoother.run(iterations);
            meter.restart();
            meter.measure(smoother.shifts());
            const Positions moved = apply_filter(*surface.topology, surface.points(),
                                                 LaplaceParameters{}, {.iterations = iterations});
            check_all(meter.read().front(), on_cpu(surface, moved), bounds(surface).diagonal());
        }
    }
}

SCENARIO("Normals, curvature and error at each vertex agree with the CPU's", "[gpu][meter]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        INFO(name);
        const auto device = uploaded(*test, surface);
        const std::size_t count = surface.vertex_count();
        GpuSmoother smoother(device, {});
        smoother.start(LaplaceHcParameters{});
        smoother.run(10);
        GpuMeter meter(device);
        meter.measure(smoother.shifts());
        const auto normals = read_vertices<Eigen::Vector4f>(*device, meter.normals());
        const auto errors = read_vertices<float>(*device, meter.errors());
        const Surface moved = surface.with_positions(smoother.positions());
        const Positions wanted = vertex_normals(moved);
        const auto curvature = mean_curvature(moved).values;
        const auto error = local_error(*surface.topology, surface.points(), moved.points()).values;
        const double allowed = 1e-6 * bounds(surface).diagonal();
        std::size_t other_normals = 0, other_curvatures = 0, other_errors = 0;
        for (std::size_t v = 0; v < count; ++v) {
            const Vec3 normal = normals[v].head<3>().cast<double>();
            other_normals += (normal - wanted[v]).norm() > 1e-4 ? 1 : 0;
            other_curvatures +=
                std::abs(normals[v].w() - curvature[v]) > 1e-3 * std::abs(curvature[v]) + 1e-4 ? 1
                                                                                               : 0;
            other_errors +=
                std::abs(errors[v] - error[v]) > std::max(allowed, 1e-4 * error[v]) ? 1 : 0;
        }
        CHECK(other_normals <= count / 1000);
        CHECK(other_curvatures <= count / 100);
        CHECK(other_errors == 0);
    }
}

SCENARIO("A sphere measures as a sphere on the device", "[gpu][meter]") {
    const auto test = test_device();
    if (!test) return;
    const double radius = 7.0, pi = std::numbers::pi;
    const auto device = uploaded(*test, icosphere(radius, 5, Vec3(300.0, -20.0, 5.0)));
    GpuMeter meter(device);
    meter.measure(device->shifts());
    const QualityMeasures measures = meter.read().front().quality;
    CHECK(measures.error == Approx(0.0).margin(1e-5));
    CHECK(measures.curvature == Approx(4.0 * pi * radius).epsilon(2e-3));
    CHECK(measures.curvature_abs == Approx(measures.curvature));
    CHECK(measures.volume == Approx(4.0 / 3.0 * pi * std::pow(radius, 3)).epsilon(2e-3));
}

SCENARIO("Many states are measured before one reading", "[gpu][meter]") {
    const auto test = test_device();
    if (!test) return;
    const auto device = uploaded(*test, open_tube(2.0, 10.0, 16, 20));
    GpuSmoother smoother(device, {.keep_boundary = false});
    GpuMeter many(device, 4), one(device);
    smoother.start(LaplaceParameters{});
    std::vector<QualityMeasures> singly;
    for (std::size_t i = 0; i < 4; ++i) {
        many.measure(smoother.shifts(), i);
        one.measure(smoother.shifts());
        singly.push_back(one.read().front().quality);
        smoother.run(5);
    }
    const auto together = many.read(4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(together[i].quality.error == singly[i].error);
        CHECK(together[i].quality.volume == singly[i].volume);
        if (i > 0) CHECK(together[i].quality.error > together[i - 1].quality.error);
        if (i > 0) CHECK(together[i].quality.volume < together[i - 1].quality.volume);
    }
}

SCENARIO("Work groups in several rows do the same", "[gpu][meter][smoother]") {
    auto test = test_device();
    if (!test) return;
    const Surface sphere = varied_surfaces().front().surface;
    const Surface tube = open_tube(2.0, 30.0, 40, 60);
    const auto found = [&](const Surface& surface) {
        const auto device = uploaded(*test, surface);
        GpuSmoother smoother(device, {});
        smoother.start(LaplaceHcParameters{});
        smoother.run(10);
        GpuMeter meter(device, 1, true);
        meter.measure(smoother.shifts());
        return std::pair(smoother.positions(), meter.read().front().quality);
    };
    for (const Surface& surface : {sphere, tube}) {
        test->device.limits.largest_group_count = 65535;
        const auto in_one = found(surface);
        for (const std::size_t limit : {1, 3, 7}) {
            test->device.limits.largest_group_count = limit;
            CHECK(found(surface) == in_one);
        }
    }
}

SCENARIO("References of a run are followed only when asked to", "[gpu][meter]") {
    const auto test = test_device();
    if (!test) return;
    const auto device = uploaded(*test, varied_surfaces().front().surface);
    const auto read = [&](const Buffer& references) {
        auto vertices = read_vertices<VertexId>(*device, references);
        for (VertexId& v : vertices) v = device->order().vertex_at(v);
        return vertices;
    };
    GpuSmoother smoother(device, {});
    GpuMeter meter(device);
    smoother.start(LaplaceParameters{1.0});
    smoother.run(30);
    const PooledBuffer references = meter.make_references();
    const auto own = read(references);
    CHECK(own == own_references(*device->surface().topology));
    meter.measure(smoother.shifts(), references, false);
    const double unfollowed = meter.read().front().quality.error;
    CHECK(read(references) == own);
    meter.follow(smoother.shifts(), references);
    const auto followed = read(references);
    CHECK(followed != own);
    std::vector<VertexId> wanted = own;
    follow_drift(*device->surface().topology, device->surface().points(), smoother.positions(),
                 wanted);
    CHECK(followed == wanted);
    meter.measure(smoother.shifts(), references, true);
    CHECK(meter.read().front().quality.error == Approx(unfollowed));
}
