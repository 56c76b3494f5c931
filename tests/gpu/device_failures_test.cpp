// A device that fails, now or at any command: what is measured is right, or an error.

#include <algorithm>
#include <limits>
#include <random>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/compute.h"
#include "gpu/device_caps.h"
#include "gpu/device_neighbours.h"
#include "gpu/filter_on_device.h"
#include "gpu/gpu_engine.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "gpu/gpu_weights.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
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
        HeldDevice held = watched_device();
        held.device.fails = [this](DeviceCommand) { return ++commands == failing; };
        return held;
    }
};

/// Devices that share a context, each without its next command.
class EachCommand {
public:
    explicit EachCommand(Device base) : base_(std::move(base)) {}

    /// Goes on to the next command. \return false behind the last one
    bool next() {
        most_ = std::max(most_, commands_);
        commands_ = 0;
        return failing_++ <= most_;
    }

    /// The first device does not fail.
    [[nodiscard]] Device device() {
        Device device = base_;
        device.health = std::make_shared<DeviceHealth>();
        device.fails = [this](DeviceCommand) { return ++commands_ == failing_ - 1; };
        return device;
    }

    [[nodiscard]] int commands() const { return most_; }

private:
    Device base_;
    int failing_ = 0, commands_ = 0, most_ = 0;
};

/// Checks that work whose result does not depend on the device gives the same or throws
/// GpuUnavailable, whichever command fails.
template <class Work>
void right_or_refused(const Device& base, const Work& work) {
    EachCommand each(base);
    REQUIRE(each.next());
    const auto wanted = work(each.device());
    int refused = 0;
    while (each.next()) {
        try {
            const auto found = work(each.device());
            CHECK(found == wanted);
        } catch (const GpuUnavailable&) {
            ++refused;
        }
    }
    CHECK(each.commands() > 8);
    CHECK(refused >= each.commands() - 3);  // a buffer from the pool is not allocated again
}

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

SCENARIO("Whichever command fails with rims, weights and staircases, a run's measures are right",
         "[gpu][failures]") {
    const auto test = test_device();
    if (!test) return;
    const Surface tube = open_tube(2.0, 10.0, 12, 8);
    const FilterGround ground = ground_of(tube);
    const auto others = std::make_shared<const std::vector<double>>(tube.vertex_count(), 0.5);
    const StaircaseGround staircases{.stack_axes = Vec3(0.3, -0.2, 2.0), .others = others};
    const StaircaseWeights on_cpu = [&](double tau_theta, double tau_max, double beta_min) {
        const auto change =
            orientation_change(*tube.topology, tube.points(), staircases.stack_axes);
        auto weights =
            staircase_weights(*tube.topology, tube.points(), change,
                              {.tau_theta = tau_theta, .tau_max = tau_max, .beta_min = beta_min});
        for (double& weight : weights) weight *= 0.5;
        return std::make_shared<const std::vector<double>>(std::move(weights));
    };
    const StaircaseValues values{0.01, 1.0, 0.2};
    const SmoothingChoice choice{
        LaplaceParameters{}, nullptr,
        std::make_shared<const SmoothingChoice::Staircase>(values, on_cpu)};
    const std::vector<int> iterations{3, 5};
    const auto wanted = make_cpu_engine(ground)->start(choice)->measure_at(iterations, {});
    std::size_t taken_over = 0;
    EachCommand each(test->device);
    while (each.next()) {
        const ChosenEngine chosen = make_engine(
            DeviceChoice::Gpu, ground, false,
            [&] {
                return HeldDevice{nullptr, each.device()};
            },
            staircases);
        CHECK(chosen.on_gpu == chosen.reason.empty());
        const auto found = chosen.engine->start(choice)->measure_at(iterations, {});
        check_close(found, wanted);
        taken_over += found == wanted ? 1 : 0;
    }
    CHECK(each.commands() > 40);
    CHECK(taken_over > 20);
}

SCENARIO("Whichever command fails in a detection or a filter, its result is right or an error",
         "[gpu][failures]") {
    const auto test = test_device();
    if (!test) return;
    const auto surface_of = [&](const Device& device, const Surface& shape) {
        // a topology of its own: it is uploaded in every attempt
        return std::make_shared<const DeviceSurface>(
            device,
            make_surface(shape.points(), {shape.triangles().begin(), shape.triangles().end()}));
    };
    const Surface tube = open_tube(2.0, 10.0, 12, 8), closed = closed_tube(3.0, 20.0, 48, 20);
    GIVEN("staircase weights") {
        right_or_refused(test->device, [&](const Device& device) {
            GpuWeights weights(surface_of(device, tube));
            weights.find_orientation_change(Vec3(0.3, -0.2, 2.0));
            weights.multiply_staircases({.tau_theta = 0.01, .tau_max = 1.0, .beta_min = 0.2});
            return read_storage<float>(device, weights.weights(), tube.vertex_count());
        });
    }
    GIVEN("distances to a neighbour and their weights") {
        const std::vector<Surface> neighbours{icosphere(2.0, 1, Vec3(3, 0, 5))};
        right_or_refused(test->device, [&](const Device& device) {
            const auto surface = surface_of(device, tube);
            GpuWeights weights(surface);
            weights.multiply_distances(find_neighbour_distances(*surface, neighbours));
            return read_storage<float>(device, weights.weights(), tube.vertex_count());
        });
    }
    GIVEN("caps") {
        REQUIRE(find_caps(closed).size() == 2);
        right_or_refused(test->device, [&](const Device& device) {
            std::vector<std::vector<TriangleId>> triangles;
            for (const Cap& cap : find_caps(*surface_of(device, closed)))
                triangles.push_back(cap.triangles);
            return triangles;
        });
    }
    GIVEN("a filter with weights, from where the surface is and from elsewhere") {
        const auto larger = mapped(tube, [](const Vec3& p) { return Vec3(1.1 * p); }).positions;
        const std::vector<double> weights(tube.vertex_count(), 0.5);
        right_or_refused(test->device, [&](const Device& device) {
            const auto there = surface_of(device, tube);
            std::vector<Positions> found;
            for (const auto& start : {there->surface().positions, larger})
                found.push_back(filter_on_device(there, start, CurvatureTriggeredParameters{},
                                                 {.weights = weights}));
            return found;
        });
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

SCENARIO("On a thread with a context of its own a device is lost", "[gpu][failures]") {
    const auto test = test_device();
    if (!test) return;
    const std::vector<std::uint32_t> words(4, 7);
    const Buffer buffer =
        make_storage(test->device, std::span<const std::uint32_t>(words), "words");
    const Device elsewhere = current_device();
    std::thread([&] {
        const HeldDevice own = watched_device();
        // Names are given in each context again, so it has a buffer of that name, too.
        const Buffer other = make_storage(own.device, 16, "other");
        CHECK_THROWS_WITH(require_context(elsewhere), Catch::Contains("another context"));
        CHECK_THROWS_AS(read_storage<std::uint32_t>(elsewhere, buffer, 4), GpuUnavailable);
        CHECK_NOTHROW(require_context(own.device));
    }).join();
    CHECK(read_storage<std::uint32_t>(test->device, buffer, 4) == words);
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
    CHECK_FALSE(is_bounded(meter.read().front().quality, 20.0));
}

SCENARIO("Whatever bits positions and references have, measures end", "[gpu][failures]") {
    const auto test = test_device();
    if (!test) return;
    const auto device = uploaded(*test, icosphere(5.0, 3));
    const Device& on = device->device();
    const std::size_t count = device->vertex_count();
    GpuMeter meter(device, 1, true);
    const PooledBuffer references = meter.make_references();
    std::mt19937 random(3);
    std::vector<std::uint32_t> any(4 * count);
    std::ranges::generate(any, random);
    const auto words = [&](std::uint32_t word) { return std::vector(4 * count, word); };
    for (const auto& bits : {words(0x7fc00000), words(0xffffffff), words(0x7f800000), any}) {
        const Buffer shifts = make_storage(on, std::span<const std::uint32_t>(bits), "damaged");
        meter.follow(shifts, references);
        meter.measure(shifts, references, true);
        CHECK_FALSE(is_bounded(meter.read().front().quality, 5.0));
    }
    for (const auto& bits : {words(0xffffffff), any}) {
        const Buffer damaged = make_storage(on, std::span<const std::uint32_t>(bits), "damaged");
        meter.follow(device->shifts(), damaged);
        meter.measure(device->shifts(), damaged, true);
        CHECK_NOTHROW(meter.read());
    }
}
