// A device that fails, now or at any command: what is measured is right, or an error.

#include <limits>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/compute.h"
#include "gpu/gpu_engine.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "smoothing/quality/cpu_engine.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const SmoothingChoice kChoice{LaplaceHcParameters{}, nullptr};

FilterGround ground_of(const Surface& surface) {
    return {.topology = surface.topology, .start = surface.positions};
}

/// A smoothing run, continued and copied, with its measures.
std::vector<QualityMeasures> measures_of(const SmoothingEngine& engine) {
    std::vector<QualityMeasures> measures{engine.original()};
    const auto run = engine.start(kChoice);
    for (const int iterations : {2, 5}) {
        run->advance_to(iterations, {});
        measures.push_back(run->measure());
    }
    const auto other = run->copy();
    other->advance_to(9, {});
    measures.push_back(other->measure());
    return measures;
}

void check_close(const std::vector<QualityMeasures>& found,
                 const std::vector<QualityMeasures>& wanted) {
    REQUIRE(found.size() == wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(found[i].error == Approx(wanted[i].error).epsilon(1e-3).margin(1e-5));
        CHECK(found[i].curvature == Approx(wanted[i].curvature).epsilon(1e-3));
        CHECK(found[i].volume == Approx(wanted[i].volume).epsilon(1e-4));
    }
}

/// Devices of which the command of this number fails, and commands so far.
struct FailingSource {
    int failing = 0;
    int commands = 0;

    HeldDevice operator()() {
        HeldDevice held = offscreen_device();
        held.device.fails = [this](DeviceCommand) { return ++commands == failing; };
        return held;
    }
};

}  // namespace

SCENARIO("Whichever command fails, a run's measures are right", "[gpu][failures]") {
    if (!test_device()) return;
    const Surface sphere = icosphere(5.0, 2);
    const auto wanted = measures_of(*make_cpu_engine(ground_of(sphere)));
    FailingSource whole;
    const auto engine_of = [&](FailingSource& source) {
        return make_engine(DeviceChoice::Gpu, ground_of(sphere), false, std::ref(source));
    };
    check_close(measures_of(*engine_of(whole).engine), wanted);
    REQUIRE(whole.commands > 50);
    for (int failing = 1; failing <= whole.commands; ++failing) {
        INFO("command " << failing << " of " << whole.commands);
        FailingSource source{.failing = failing};
        const ChosenEngine chosen = engine_of(source);
        CHECK(chosen.on_gpu == chosen.reason.empty());
        check_close(measures_of(*chosen.engine), wanted);
        CHECK(source.commands >= failing);
    }
}

SCENARIO("A reset that the driver reports once is remembered", "[gpu][failures]") {
    auto test = test_device();
    if (!test) return;
    bool reset = false;
    test->device.lost = [&] { return std::exchange(reset, false); };
    const Buffer buffer = make_storage(test->device, 64, "words");
    fill_storage(test->device, buffer, 7);
    CHECK(read_storage<std::uint32_t>(test->device, buffer, 1).front() == 7);
    reset = true;
    for (int i = 0; i < 2; ++i) {
        CHECK_THROWS_AS(require_context(test->device), GpuUnavailable);
        CHECK_THROWS_AS(read_storage<std::uint32_t>(test->device, buffer, 1), GpuUnavailable);
    }
}

SCENARIO("On a thread without a context a device is lost", "[gpu][failures]") {
    const auto test = test_device();
    if (!test) return;
    const Buffer buffer = make_storage(test->device, 64, "words");
    const Device elsewhere = current_device();
    std::thread([&] {
        CHECK_THROWS_AS(require_context(elsewhere), GpuUnavailable);
        CHECK_THROWS_AS(read_storage<std::uint32_t>(elsewhere, buffer, 1), GpuUnavailable);
    }).join();
    CHECK_NOTHROW(require_context(test->device));
}

SCENARIO("An error of the driver is found when something is read", "[gpu][failures]") {
    auto test = test_device();
    if (!test) return;
    test->reports.reset();
    const Buffer small = make_storage(test->device, 16, "small");
    copy_storage(test->device, small, small, 1 << 20);  // beyond its end
    CHECK_THROWS_WITH(read_storage<float>(test->device, small, 4),
                      Catch::Contains("the driver refused a command"));
}

SCENARIO("Numbers beyond single precision end a run, and no loop runs on", "[gpu][failures]") {
    const auto test = test_device();
    if (!test) return;
    const Surface noisy = varied_surfaces().front().surface;
    const auto device = uploaded(*test, noisy);
    GpuSmoother smoother(device, {});
    smoother.start(TaubinParameters{.lambda = 1.0, .mu = -2.0});
    smoother.run(200);
    CHECK_THROWS_WITH(smoother.positions(), Catch::Contains("diverges"));
    GpuMeter meter(device);
    const PooledBuffer references = meter.make_references();
    meter.follow(smoother.shifts(), references);
    meter.measure(smoother.shifts(), references, true);
    CHECK_NOTHROW(meter.read());
}
