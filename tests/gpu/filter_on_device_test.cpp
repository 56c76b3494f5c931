#include "gpu/filter_on_device.h"

#include <functional>
#include <map>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/device_choice.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

const FilterParameters kFilter = LaplaceHcParameters{};

/// A device with a change.
DeviceSource changed(const std::function<void(Device&)>& change,
                     const DeviceSource& source = watched_device) {
    return [change, source] {
        HeldDevice held = source();
        change(held.device);
        return held;
    };
}

/// Filters a sphere on a device that fails. \return what it throws
std::string failure_of(const std::function<void(Device&)>& change,
                       const DeviceSource& source = watched_device) {
    const Surface sphere = icosphere(5.0, 4);
    const HeldDevice held = changed(change, source)();
    try {
        const auto there = std::make_shared<const DeviceSurface>(held.device, sphere);
        static_cast<void>(filter_on_device(there, sphere.positions, kFilter));
    } catch (const GpuUnavailable& error) {
        return error.what();
    }
    return "nothing was thrown";
}

}  // namespace

SCENARIO("A device filters as the CPU does, from where it is asked to", "[gpu][device]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    const auto there = uploaded(*test, sphere);
    const auto larger = mapped(sphere, [](const Vec3& p) { return Vec3(1.1 * p); }).positions;
    for (const auto& start : {sphere.positions, larger})
        CHECK(relative_distances(apply_filter(*sphere.topology, *start, kFilter),
                                 filter_on_device(there, start, kFilter))
                  .back() <= 2e-6);
}

SCENARIO("A choice takes a device that computes, or says why not", "[gpu][device-choice]") {
    CHECK_FALSE(choose_device(DeviceChoice::Cpu).device);
    CHECK(choose_device(DeviceChoice::Cpu).reason.empty());
    const ChosenDevice none =
        choose_device(DeviceChoice::Gpu, []() -> HeldDevice { throw GpuUnavailable("no EGL"); });
    CHECK_FALSE(none.device);
    CHECK(none.reason == "no EGL");
    const auto test = test_device();
    if (!test) return;
    CHECK(choose_device(DeviceChoice::Gpu).device);
    const ChosenDevice old = choose_device(DeviceChoice::Gpu, changed([](Device& device) {
                                               device.limits.major = 4;
                                               device.limits.minor = 1;
                                           }));
    CHECK_FALSE(old.device);
    CHECK_THAT(old.reason, Contains("OpenGL 4.1") && Contains("4.3"));
    THEN("auto takes the device unless it computes on the CPU itself") {
        const bool software = is_software(test->device.limits);
        const ChosenDevice chosen = choose_device(DeviceChoice::Auto);
        CHECK(chosen.device.has_value() == !software);
        if (software) CHECK_THAT(chosen.reason, Contains(test->device.limits.renderer));
        const DeviceSource hardware =
            changed([](Device& device) { device.limits.renderer = "a card"; });
        CHECK(choose_device(DeviceChoice::Auto, hardware).device);
    }
}

SCENARIO("A device that fails says how", "[gpu][device]") {
    const auto test = test_device();
    if (!test) return;
    CHECK_THAT(failure_of([](Device& device) { device.limits.largest_storage_block = 20'000; }),
               Contains("20000"));
    std::map<std::string, std::string> texts = *test->device.shaders;
    texts["umbrella.glsl"] += "float wrong() { return nothing; }\n";
    CHECK_THAT(failure_of([&](Device& device) { device.shaders = &texts; },
                          offscreen_device),  // it reports what does not compile
               Contains("linear_step.comp does not compile") && Contains("umbrella.glsl:"));
    for (const int good_looks : {0, 1, 2}) {
        int looks = 0;
        const auto lost = [&] { return looks++ >= good_looks; };
        CHECK_THAT(failure_of([&](Device& device) { device.lost = lost; }),
                   Contains("driver was reset"));
        CHECK(looks > good_looks);
    }
}

SCENARIO("Wrong parameters and a wish to stop end a run on a device", "[gpu][device]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 2);
    const auto there = uploaded(*test, sphere);
    CHECK_THROWS_AS(filter_on_device(there, sphere.positions, LaplaceParameters{2.0}),
                    InvalidInput);
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(
        filter_on_device(there, sphere.positions, kFilter, {}, Progress({}, stop.get_token())),
        Cancelled);
}
