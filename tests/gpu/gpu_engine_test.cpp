#include "gpu/gpu_engine.h"

#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "geometry/errors.h"
#include "geometry/measure.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

FilterGround ground_of(const Surface& surface) {
    return {.topology = surface.topology, .start = surface.positions};
}

void check_close(const QualityMeasures& device, const QualityMeasures& cpu, double diagonal) {
    const auto near = [&](double a, double b) {
        INFO(a << " on the device, " << b << " on the CPU");
        CHECK(std::abs(a - b) <= std::max(1e-4 * std::abs(b), 1e-6 * diagonal));
    };
    near(device.error, cpu.error);
    near(device.error_thesis, cpu.error_thesis);
    near(device.curvature, cpu.curvature);
    near(device.curvature_abs, cpu.curvature_abs);
    near(device.volume, cpu.volume);
}

/// Both engines' measures at the same iterations.
void compare_runs(const SmoothingEngine& device, const SmoothingEngine& cpu,
                  const SmoothingChoice& choice, double diagonal) {
    const auto on_device = device.start(choice), on_cpu = cpu.start(choice);
    for (const int iterations : {0, 3, 5, 12, 30}) {
        INFO(iterations << " iterations");
        on_device->advance_to(iterations, {});
        on_cpu->advance_to(iterations, {});
        CHECK(on_device->iterations() == iterations);
        check_close(on_device->measure(), on_cpu->measure(), diagonal);
    }
}

}  // namespace

SCENARIO("A search on the device sees what it sees on the CPU", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        INFO(name);
        const double diagonal = bounds(surface).diagonal();
        const ChosenEngine chosen = make_engine(DeviceChoice::Gpu, ground_of(surface), true);
        REQUIRE(chosen.on_gpu);
        CHECK(chosen.reason.empty());
        const auto cpu = make_cpu_engine(ground_of(surface), true);
        check_close(chosen.engine->original(), cpu->original(), diagonal);
        CHECK(chosen.engine->mean_edge() == Approx(cpu->mean_edge()));
        CHECK_FALSE(chosen.engine->concurrent());
        auto weights = std::make_shared<std::vector<double>>(surface.vertex_count(), 1.0);
        for (std::size_t v = 0; v < weights->size(); v += 3) (*weights)[v] = 0.25;
        compare_runs(*chosen.engine, *cpu, {LaplaceParameters{0.8}, nullptr}, diagonal);
        compare_runs(*chosen.engine, *cpu, {LaplaceHcParameters{}, weights}, diagonal);
    }
}

SCENARIO("Weights that were uploaded before serve again", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 10.0, 16, 20);
    const auto engine = make_engine(DeviceChoice::Gpu, ground_of(tube)).engine;
    const auto measured = [&](const std::shared_ptr<const std::vector<double>>& weights) {
        const auto run = engine->start({LaplaceParameters{}, weights});
        run->advance_to(5, {});
        return run->measure();
    };
    std::vector<std::shared_ptr<const std::vector<double>>> all;
    std::vector<QualityMeasures> first;
    for (int i = 0; i < 20; ++i) {
        all.push_back(std::make_shared<std::vector<double>>(tube.vertex_count(), 0.05 * i));
        first.push_back(measured(all.back()));
        if (i > 0) CHECK(first[i].error > first[i - 1].error);
    }
    for (int i = 19; i >= 0; --i) CHECK(measured(all[i]) == first[i]);
    CHECK_THROWS_AS(measured(std::make_shared<std::vector<double>>(3, 1.0)), InvalidInput);
}

SCENARIO("A copied run of the device goes on as the run itself", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 10.0, 16, 20);
    const auto engine = make_engine(DeviceChoice::Gpu, ground_of(tube)).engine;
    const auto first = engine->start({TaubinParameters{}, nullptr});
    first->advance_to(7, {});
    const auto second = first->copy();
    first->advance_to(20, {});
    const QualityMeasures wanted = first->measure();
    CHECK_FALSE(second->measure() == wanted);
    second->advance_to(20, {});
    CHECK(second->measure() == wanted);
    CHECK_THROWS_AS(engine->start({LaplaceParameters{3.0}, nullptr}), InvalidInput);
    const auto short_weights = std::make_shared<const std::vector<double>>(3, 1.0);
    CHECK_THROWS_AS(engine->start({LaplaceParameters{}, short_weights}), InvalidInput);
}

SCENARIO("Where the device fails in a search, the CPU takes over", "[gpu][engine]") {
    const Surface sphere = icosphere(5.0, 4);
    const auto cpu = make_cpu_engine(ground_of(sphere));
    const SmoothingChoice choice{LaplaceParameters{}, nullptr};
    const auto wanted_at = [&](int iterations) {
        const auto run = cpu->start(choice);
        run->advance_to(iterations, {});
        return run->measure();
    };
    GIVEN("no device at all") {
        const ChosenEngine chosen =
            make_engine(DeviceChoice::Gpu, ground_of(sphere), false,
                        []() -> HeldDevice { throw GpuUnavailable("EGL has no device"); });
        CHECK_FALSE(chosen.on_gpu);
        CHECK(chosen.reason == "EGL has no device");
        const auto run = chosen.engine->start(choice);
        run->advance_to(10, {});
        CHECK(run->measure() == wanted_at(10));
    }
    const auto test = test_device();
    if (!test) return;
    bool lost = false;
    const DeviceSource source = [&] {
        HeldDevice held = offscreen_device();
        held.device.lost = [&] { return lost; };
        return held;
    };
    GIVEN("a context that is lost between two iterations") {
        const ChosenEngine chosen =
            make_engine(DeviceChoice::Gpu, ground_of(sphere), false, source);
        REQUIRE(chosen.on_gpu);
        const auto run = chosen.engine->start(choice);
        run->advance_to(10, {});
        check_close(run->measure(), wanted_at(10), 17.3);
        lost = true;
        run->advance_to(25, {});
        CHECK(run->iterations() == 25);
        CHECK(run->measure() == wanted_at(25));
        const auto later = chosen.engine->start(choice);
        later->advance_to(5, {});
        CHECK(later->measure() == wanted_at(5));
    }
    GIVEN("a context that is lost before a measure") {
        const ChosenEngine chosen =
            make_engine(DeviceChoice::Gpu, ground_of(sphere), false, source);
        const auto run = chosen.engine->start(choice);
        run->advance_to(10, {});
        lost = true;
        CHECK(run->measure() == wanted_at(10));
        CHECK(run->copy()->measure() == wanted_at(10));
    }
    GIVEN("a shader that does not compile") {
        const std::map<std::string, std::string> none;
        const ChosenEngine chosen = make_engine(DeviceChoice::Gpu, ground_of(sphere), false, [&] {
            HeldDevice held = offscreen_device();
            held.device.shaders = &none;
            return held;
        });
        CHECK_FALSE(chosen.on_gpu);
        CHECK(chosen.reason.find("there is no shader") == 0);
        CHECK(chosen.engine->original() == cpu->original());
    }
}
