#include "workbench/operations/smooth/live_smoother.h"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "smoothing/filters/laplace.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

CheckedArguments arguments(const Arguments& given) {
    return checked_arguments(find_operation("smooth"), given);
}

Outcome applied(const Scene& scene, const Arguments& given) {
    Progress progress;
    return run_here(find_operation("smooth"), scene, arguments(given), progress);
}

/// The last state of a run, made exact.
LiveSmoother::State exact_state(LiveSmoother& live, const Arguments& given) {
    return live.exact(live.run(arguments(given), [](const LiveSmoother::State&) {}, {}), {});
}

/// What the operation itself would say of the same arguments.
void require_applied(LiveSmoother& live, const Scene& scene, const Arguments& given) {
    const LiveSmoother::State state = exact_state(live, given);
    const Outcome outcome = applied(scene, given);
    REQUIRE(state.exact);
    REQUIRE(state.whole);
    REQUIRE(state.surface.points() == outcome.scene.surface->points());
    REQUIRE(state.change);
    const auto& report = *outcome.report;
    REQUIRE(report["local_error"]["mean_mm"] == state.change->error.mean);
    REQUIRE(report["volume_change_percent"] == state.change->volume_change_percent);
    REQUIRE(report["normal_curvature_after_deg"] == state.change->normal_curvature_after_deg);
    for (const char* name : {"iterations", "lambda"})
        REQUIRE(state.resolved.values().at(name) == outcome.resolved.values().at(name));
}

}  // namespace

SCENARIO("Live smoothing ends where the operation does, whatever came before",
         "[workbench][smooth][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 36));
    LiveSmoother live(scene);
    require_applied(live, scene, {});
    require_applied(live, scene, {{"iterations", std::int64_t{35}}});
    require_applied(live, scene, {{"iterations", std::int64_t{7}}});
    require_applied(live, scene, {{"iterations", std::int64_t{0}}});
    require_applied(live, scene, {{"lambda", 0.8}, {"filter", std::string("laplace")}});
    require_applied(live, scene, {{"filter", std::string("mean-curvature-flow")}});
    require_applied(live, scene, {{"filter", std::string("taubin")}, {"rings", std::int64_t{2}}});
    require_applied(live, scene, {{"caps", std::string("round")}});
    require_applied(live, scene, {});
}

SCENARIO("Live weights are those of the operation", "[workbench][smooth][live]") {
    GIVEN("staircases, whose thresholds are decided or given") {
        const Scene scene = scene_of(of_mask(vessel_in_slices()));
        LiveSmoother live(scene);
        require_applied(live, scene, {{"staircase", true}});
        for (const double tau_theta : {0.3, 0.5})
            require_applied(live, scene, {{"staircase", true}, {"tau_theta", tau_theta}});
        require_applied(live, scene, {{"staircase", true}, {"beta_min", 0.4}});
        require_applied(live, scene, {{"staircase", true}, {"tau_max", 1.5}});
        require_applied(live, scene, {{"staircase", true}});
    }
    GIVEN("a neighbour") {
        Scene scene = scene_of(open_tube(2.0, 30.0, 40, 60));
        scene.neighbours["ball"] = icosphere(4.0, 3, Vec3(6, 0, 10));
        LiveSmoother live(scene);
        const Arguments margin = {{"distance", std::string("margin")}, {"margin", 1.0}};
        require_applied(live, scene, margin);
        require_applied(live, scene, {{"distance", std::string("margin")}, {"margin", 3.0}});
        require_applied(live, scene, {{"distance", std::string("exponential")}, {"omega", 0.2}});
    }
}

SCENARIO("While iterations take long, what is done so far is sent", "[workbench][smooth][live]") {
    const Scene scene = scene_of(icosphere(5.0, 6));
    LiveSmoother live(scene);
    const Arguments given = {{"filter", std::string("laplace")},
                             {"iterations", std::int64_t{9000}}};
    std::vector<LiveSmoother::State> sent;
    static_cast<void>(live.run(
        arguments(given), [&](const LiveSmoother::State& state) { sent.push_back(state); }, {}));
    REQUIRE(sent.size() > 2);
    CHECK(sent.back().whole);
    CHECK(sent.back().iterations == 9000);
    CHECK(std::ranges::is_sorted(sent, {}, &LiveSmoother::State::iterations));
    const LiveSmoother::State& part = sent.front();
    REQUIRE_FALSE(part.whole);
    REQUIRE(part.iterations < 9000);
    CHECK_FALSE(part.exact);
    THEN("each is the filter's result after so many iterations") {
        CHECK(part.surface.points() == laplace(*scene.surface->topology, scene.surface->points(),
                                               {.lambda = part.resolved.real("lambda")},
                                               {.iterations = part.iterations}));
    }
    THEN("the next run continues from what is done") {
        require_applied(live, scene, given);
    }
}

SCENARIO("A cancelled run leaves what it has done to the next", "[workbench][smooth][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 36));
    LiveSmoother live(scene);
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(
        live.run(
            arguments({}), [](const LiveSmoother::State&) {}, Progress(nullptr, stop.get_token())),
        Cancelled);
    require_applied(live, scene, {});
}

SCENARIO("A filter that diverges is refused, and the next value is not",
         "[workbench][smooth][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 36));
    LiveSmoother live(scene);
    const Arguments wild = {{"filter", std::string("taubin")},
                            {"mu", -2.0},
                            {"lambda", 1.0},
                            {"iterations", std::int64_t{400}}};
    CHECK_THROWS_AS(exact_state(live, wild), AlgorithmFailure);
    require_applied(live, scene, {{"filter", std::string("taubin")}});
}

SCENARIO("On a device, states differ by rounding until they are exact",
         "[workbench][smooth][live][device]") {
    const auto test = test_device();
    if (!test) return;
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 36));
    LiveSmoother live(scene, HeldDevice{nullptr, test->device});
    const auto state = live.run(arguments({}), [](const LiveSmoother::State&) {}, {});
    CHECK(state.device == "gpu");
    const Outcome outcome = applied(scene, {});
    CHECK(relative_distances(outcome.scene.surface->points(), state.surface.points()).back() <
          1e-5);
    require_applied(live, scene, {});
}
