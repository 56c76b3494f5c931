#include "gpu/filter_on_device.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

const FilterParameters kFilter = LaplaceHcParameters{};

/// The offscreen device with a change.
DeviceSource changed(const std::function<void(Device&)>& change) {
    return [change] {
        HeldDevice held = offscreen_device();
        change(held.device);
        return held;
    };
}

/// Runs with device=gpu on a device that fails; the CPU must have served, bit for bit.
/// \return the reason that is given
std::string reason_of(const DeviceSource& source) {
    const Surface sphere = icosphere(5.0, 4);
    const DeviceRun run = apply_filter_on(DeviceChoice::Gpu, sphere, kFilter, {}, {}, source);
    CHECK_FALSE(run.on_gpu);
    CHECK(run.device_name.empty());
    CHECK(run.positions == apply_filter(*sphere.topology, sphere.points(), kFilter));
    return run.reason;
}

}  // namespace

SCENARIO("A filter runs where it was asked to", "[gpu][device-choice]") {
    const Surface sphere = icosphere(5.0, 3);
    const Positions wanted = apply_filter(*sphere.topology, sphere.points(), kFilter);
    const DeviceRun cpu = apply_filter_on(DeviceChoice::Cpu, sphere, kFilter);
    CHECK_FALSE(cpu.on_gpu);
    CHECK(cpu.reason.empty());
    CHECK(cpu.positions == wanted);
    const auto test = test_device();
    if (!test) return;
    const DeviceRun gpu = apply_filter_on(DeviceChoice::Gpu, sphere, kFilter);
    CHECK(gpu.on_gpu);
    CHECK(gpu.device_name == test->device.limits.renderer);
    CHECK(gpu.reason.empty());
    CHECK(relative_distances(wanted, gpu.positions).back() <= 2e-6);
    THEN("auto takes the device unless it computes on the CPU itself") {
        const bool software = is_software(test->device.limits);
        const DeviceRun choice = apply_filter_on(DeviceChoice::Auto, sphere, kFilter);
        CHECK(choice.on_gpu == !software);
        if (software) CHECK_THAT(choice.reason, Contains(test->device.limits.renderer));
        const DeviceSource hardware =
            changed([](Device& device) { device.limits.renderer = "a card"; });
        CHECK(apply_filter_on(DeviceChoice::Auto, sphere, kFilter, {}, {}, hardware).on_gpu);
    }
}

SCENARIO("Without a driver, or with an old one, the CPU serves", "[gpu][device-choice]") {
    CHECK_THAT(reason_of([]() -> HeldDevice { throw GpuUnavailable("EGL has no device"); }),
               Contains("EGL has no device"));
    const auto test = test_device();
    if (!test) return;
    CHECK_THAT(reason_of(changed([](Device& device) {
                   device.limits.major = 4;
                   device.limits.minor = 1;
               })),
               Contains("OpenGL 4.1") && Contains("4.3"));
}

SCENARIO("Where memory runs out the CPU serves", "[gpu][device-choice]") {
    const auto test = test_device();
    if (!test) return;
    CHECK_THAT(
        reason_of(changed([](Device& device) { device.limits.largest_storage_block = 20'000; })),
        Contains("20000"));
}

SCENARIO("Where a shader does not compile the CPU serves", "[gpu][device-choice]") {
    const auto test = test_device();
    if (!test) return;
    std::map<std::string, std::string> texts = *test->device.shaders;
    texts["umbrella.glsl"] += "float wrong() { return nothing; }\n";
    CHECK_THAT(reason_of(changed([&](Device& device) { device.shaders = &texts; })),
               Contains("linear_step.comp does not compile") && Contains("umbrella.glsl:"));
}

SCENARIO("Where the context is lost half-way the CPU serves", "[gpu][device-choice]") {
    const auto test = test_device();
    if (!test) return;
    for (const int good_looks : {0, 1, 2}) {
        int looks = 0;
        const auto lost = [&] { return looks++ >= good_looks; };
        CHECK_THAT(reason_of(changed([&](Device& device) { device.lost = lost; })),
                   Contains("driver was reset"));
        CHECK(looks > good_looks);
    }
}

SCENARIO("What the device found is forgotten where it fails later", "[gpu][device-choice]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 30.0, 40, 60);
    const std::vector<Surface> neighbours{icosphere(4.0, 3, Vec3(6, 0, 10))};
    int preparations = 0;
    std::vector<double> weights;
    const auto prepare = [&](ContextFinder& finder) -> FilterStart {
        ++preparations;
        weights = finder.neighbours(neighbours, {}).weights;
        return {tube.positions, {.weights = weights}};
    };
    const auto run = [&](DeviceChoice choice, const DeviceSource& source) {
        preparations = 0;
        return apply_filter_on(choice, tube, kFilter, prepare, {}, source);
    };
    const Positions wanted = run(DeviceChoice::Cpu, offscreen_device).positions;
    CHECK(preparations == 1);
    const DeviceRun whole = run(DeviceChoice::Gpu, offscreen_device);
    CHECK(whole.on_gpu);
    CHECK(preparations == 1);
    CHECK(relative_distances(wanted, whole.positions).back() <= 1e-5);
    CHECK(whole.positions != wanted);
    for (const char* shader : {"distance_weight.comp", "linear_step.comp"}) {
        std::map<std::string, std::string> texts = *test->device.shaders;
        texts[shader] += "float wrong() { return nothing; }\n";
        const DeviceRun failed =
            run(DeviceChoice::Gpu, changed([&](Device& device) { device.shaders = &texts; }));
        CHECK_FALSE(failed.on_gpu);
        CHECK_THAT(failed.reason, Contains(std::string(shader) + " does not compile"));
        CHECK(preparations == 2);
        CHECK(failed.positions == wanted);
    }
    THEN("the filter starts where the preparation says, on the device as well") {
        const auto start = mapped(tube, [](const Vec3& p) { return Vec3(1.1 * p); }).positions;
        const auto elsewhere = [&](ContextFinder&) { return FilterStart{start, {}}; };
        const DeviceRun moved = apply_filter_on(DeviceChoice::Gpu, tube, kFilter, elsewhere);
        CHECK(moved.on_gpu);
        CHECK(relative_distances(apply_filter(*tube.topology, *start, kFilter), moved.positions)
                  .back() <= 2e-6);
    }
}

SCENARIO("Wrong parameters and a wish to stop are not hidden by the CPU", "[gpu][device-choice]") {
    const Surface sphere = icosphere(5.0, 2);
    CHECK_THROWS_AS(apply_filter_on(DeviceChoice::Gpu, sphere, LaplaceParameters{2.0}),
                    InvalidInput);
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(
        apply_filter_on(DeviceChoice::Gpu, sphere, kFilter, {}, Progress({}, stop.get_token())),
        Cancelled);
}
