#include "gpu/gpu_engine.h"

#include <cmath>
#include <map>
#include <utility>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/staircases.h"
#include "smoothing/quality/cpu_engine.h"
#include "smoothing/quality/quality_table.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"

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

std::shared_ptr<const SmoothingChoice::Staircase> staircase_choice(const StaircaseValues& values,
                                                                   const StaircaseWeights& on_cpu) {
    return std::make_shared<const SmoothingChoice::Staircase>(
        SmoothingChoice::Staircase{values, on_cpu});
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

SCENARIO("A search on the device finds what it finds on the CPU", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    for (const auto& [name, surface] : varied_surfaces()) {
        INFO(name);
        const double diagonal = bounds(surface).diagonal();
        const ChosenEngine chosen =
            make_engine(DeviceChoice::Gpu, ground_of(surface), true, watched_device);
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

SCENARIO("Uploaded weights are reused", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 10.0, 16, 20);
    const auto engine =
        make_engine(DeviceChoice::Gpu, ground_of(tube), false, watched_device).engine;
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

SCENARIO("A search's staircase weights are made on the device", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    const Surface surface = of_mask(vessel_in_slices());
    StaircaseGround staircases{.stack_axes = Vec3(0.0, 0.1, 1.0)};
    staircases.caps = cap_vertices(find_caps(surface), surface.vertex_count());
    auto others = std::make_shared<std::vector<double>>(surface.vertex_count(), 1.0);
    for (std::size_t v = 0; v < others->size(); v += 5) (*others)[v] = 0.4;
    const auto change =
        orientation_change(*surface.topology, surface.points(), staircases.stack_axes);
    int asked = 0;
    SharedWeights also;
    const StaircaseWeights on_cpu = [&](double tau_theta, double tau_max, double beta_min) {
        ++asked;
        auto weights = staircase_weights(*surface.topology, surface.points(), change,
                                         {.tau_theta = tau_theta,
                                          .tau_max = tau_max,
                                          .beta_min = beta_min,
                                          .caps = staircases.caps});
        if (also)
            for (std::size_t v = 0; v < weights.size(); ++v) weights[v] *= (*also)[v];
        return std::make_shared<const std::vector<double>>(std::move(weights));
    };
    const auto cpu = make_cpu_engine(ground_of(surface));
    const double diagonal = bounds(surface).diagonal();
    bool lost = false;
    const DeviceSource source = [&] {
        HeldDevice held = watched_device();
        held.device.lost = [&] { return lost; };
        return held;
    };
    for (const SharedWeights& more : {SharedWeights(), SharedWeights(others)}) {
        also = staircases.others = more;
        const auto engine =
            make_engine(DeviceChoice::Gpu, ground_of(surface), false, source, staircases).engine;
        REQUIRE(engine->weighs_staircases());
        CHECK_FALSE(cpu->weighs_staircases());
        for (const StaircaseValues& values :
             {StaircaseValues{0.3, 2.0, 0.0}, StaircaseValues{0.5, 4.0, 0.3},
              StaircaseValues{0.5, 4.0, 0.6}, StaircaseValues{0.3, 2.0, 0.0}}) {
            const SmoothingChoice choice{LaplaceParameters{0.8}, nullptr,
                                         staircase_choice(values, on_cpu)};
            compare_runs(*engine, *cpu, choice, diagonal);
        }
        CHECK(std::exchange(asked, 0) == 4);  // by the CPU's engine alone
        const SmoothingChoice choice{LaplaceParameters{0.8}, nullptr,
                                     staircase_choice({0.4, 3.0, 0.1}, on_cpu)};
        lost = true;
        const auto run = engine->start(choice), wanted = cpu->start(choice);
        run->advance_to(10, {});
        wanted->advance_to(10, {});
        CHECK(run->measure() == wanted->measure());
        CHECK(std::exchange(asked, 0) == 2);
        lost = false;
    }
    const auto without =
        make_engine(DeviceChoice::Gpu, ground_of(surface), false, watched_device).engine;
    CHECK_FALSE(without->weighs_staircases());
    compare_runs(*without, *cpu,
                 {LaplaceParameters{0.8}, nullptr, staircase_choice({0.4, 3.0, 0.1}, on_cpu)},
                 diagonal);
}

SCENARIO("A copied run on the device continues like the original", "[gpu][engine]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 10.0, 16, 20);
    const auto engine =
        make_engine(DeviceChoice::Gpu, ground_of(tube), false, watched_device).engine;
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

SCENARIO("If the device fails in a search, the CPU takes over", "[gpu][engine]") {
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
        HeldDevice held = watched_device();
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
            HeldDevice held = watched_device();
            held.device.shaders = &none;
            return held;
        });
        CHECK_FALSE(chosen.on_gpu);
        CHECK(chosen.reason.find("there is no shader") == 0);
        CHECK(chosen.engine->original() == cpu->original());
    }
}

SCENARIO("A search reads once for all iterations of a filter", "[gpu][engine]") {
    if (!test_device()) return;
    const Surface tube = open_tube(2.0, 10.0, 16, 20);
    std::shared_ptr<DeviceCounts> counts;
    const DeviceSource source = [&] {
        HeldDevice held = watched_device();
        counts = held.device.counts;
        return held;
    };
    const auto engine = make_engine(DeviceChoice::Gpu, ground_of(tube), false, source).engine;
    const std::vector<int> iterations = {0, 5, 7, 10, 30};
    const auto one_by_one = engine->start({TaubinParameters{}, nullptr});
    std::vector<QualityMeasures> wanted;
    for (const int i : iterations) {
        one_by_one->advance_to(i, {});
        wanted.push_back(one_by_one->measure());
    }
    const auto run = engine->start({TaubinParameters{}, nullptr});
    const DeviceCounts before = *counts;
    CHECK(run->measure_at(iterations, {}) == wanted);
    const DeviceCounts asked = since(before, *counts);
    CHECK(asked.reads == 1);
    // 60 passes, references followed at 15, 20 and 25, and 5 measures of 5 dispatches and 2
    // barriers
    CHECK(asked.dispatches == 60 + 3 + 5 * 5);
    CHECK(asked.barriers == 60 + 3 + 5 * 2);
    CHECK(run->iterations() == 30);
}

SCENARIO("Measures of a filter that diverges are refused, and a search leaves them out",
         "[gpu][engine]") {
    if (!test_device()) return;
    const Surface sphere = varied_surfaces().front().surface;
    const SmoothingChoice choice{TaubinParameters{.lambda = 1.0, .mu = -2.0}, nullptr};
    for (const auto& engine :
         {make_cpu_engine(ground_of(sphere)),
          make_engine(DeviceChoice::Gpu, ground_of(sphere), false, watched_device).engine}) {
        const auto run = engine->start(choice);
        run->advance_to(200, {});
        CHECK_THROWS_WITH(run->measure(), Catch::Contains("diverges"));
        QualityTable table(engine, [&](std::span<const double>) { return choice; });
        CHECK(table.at({1.0, 1.0}));
        CHECK_FALSE(table.at({1.0, 150.0}));
        const std::vector<ParameterSet> sets{{1.0, 2.0}, {1.0, 200.0}, {1.0, 210.0}};
        table.find(sets);
        CHECK(table.at(sets[0]));
        CHECK_FALSE(table.at(sets[1]));
        CHECK(table.knows(sets[2]));
    }
}
