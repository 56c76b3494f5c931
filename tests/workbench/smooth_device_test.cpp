#include <map>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/smooth/context_filter.h"
#include "workbench/operations/smooth/filter_choice.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A device with a change.
DeviceSource changed(const std::function<void(Device&)>& change,
                     const DeviceSource& source = watched_device) {
    return [change, source] {
        HeldDevice held = source();
        change(held.device);
        return held;
    };
}

/// A tube beside a ball, whose distance weighs the smoothing.
Scene tube_beside_ball() {
    Scene scene;
    scene.surface = open_tube(2.0, 30.0, 40, 60);
    scene.neighbours["ball"] = icosphere(4.0, 3, Vec3(6, 0, 10));
    return scene;
}

Arguments smooth_arguments(const Scene& scene, Arguments given) {
    given.set("distance", std::string("linear"));
    Arguments checked = checked_arguments(find_operation("smooth"), given);
    resolve_filter(scene, checked);
    return checked;
}

ContextFilter::Result filtered(const std::string& device, const DeviceSource& source) {
    const Scene scene = tube_beside_ball();
    return ContextFilter(scene, source).run(smooth_arguments(scene, {{"device", device}}), {});
}

/// Asks for a device that fails; the CPU must have done everything, bit for bit.
/// \return the reason that is given
std::string reason_of(const DeviceSource& source) {
    const ContextFilter::Result cpu = filtered("cpu", source), run = filtered("gpu", source);
    CHECK(run.positions == cpu.positions);
    CHECK(run.resolved.text("device") == "cpu");
    CHECK(run.device == "cpu");
    CHECK(run.figures == cpu.figures);
    CHECK(cpu.reason.empty());
    return run.reason;
}

}  // namespace

SCENARIO("Without a driver, or with an old one, the CPU smooths", "[workbench][smooth][device]") {
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

SCENARIO("Where the device fails half-way, the CPU finds the context again and smooths",
         "[workbench][smooth][device]") {
    const auto test = test_device();
    if (!test) return;
    const ContextFilter::Result whole = filtered("gpu", watched_device);
    CHECK(whole.reason.empty());
    CHECK(whole.resolved.text("device") == "gpu");
    CHECK(whole.device == "gpu");
    const Positions by_cpu = filtered("cpu", offscreen_device).positions;
    CHECK(relative_distances(by_cpu, whole.positions).back() <= 1e-5);
    CHECK(whole.positions != by_cpu);
    CHECK_THAT(
        reason_of(changed([](Device& device) { device.limits.largest_storage_block = 20'000; })),
        Contains("20000"));
    for (const char* shader : {"distance_weight.comp", "linear_step.comp"}) {
        std::map<std::string, std::string> texts = *test->device.shaders;
        texts[shader] += "float wrong() { return nothing; }\n";
        CHECK_THAT(reason_of(changed([&](Device& device) { device.shaders = &texts; },
                                     offscreen_device)),  // it reports what does not compile
                   Contains(std::string(shader) + " does not compile"));
    }
}

SCENARIO("A failing device leaves what the CPU found before", "[workbench][smooth][device]") {
    const Scene scene = tube_beside_ball();
    const DeviceSource none = []() -> HeldDevice { throw GpuUnavailable("no EGL"); };
    ContextFilter filter(scene, none);
    const auto run = [&](const std::string& device, double lambda) {
        return filter.run(smooth_arguments(scene, {{"device", device}, {"lambda", lambda}}), {});
    };
    const Positions first = run("cpu", 0.5).positions;
    CHECK(run("gpu", 0.25).positions != first);
    CHECK(run("gpu", 0.5).positions == first);
}
