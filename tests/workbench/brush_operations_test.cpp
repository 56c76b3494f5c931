#include <limits>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "geometry/io/surface_file.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operation.h"
#include "workbench/session.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Two dabs on the wall of a tube of radius 2 mm along z.
std::vector<double> stroke(double strength) {
    return {2, 0, 6, 1, 0, 0, 2, 1.5, strength, 2, 0, 7, 1, 0, 0, 2, 1.5, strength};
}

}  // namespace

SCENARIO("The brushes say what they did and replay it", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    GIVEN("brush-inflate") {
        const Outcome up = run("brush-inflate", tube, {{"dabs", stroke(0.5)}});
        CHECK(up.report->at("dabs") == 2);
        CHECK(up.report->at("vertices_moved") > 50);
        CHECK(up.report->at("volume_change_mm3") > 0.1);
        CHECK(up.report->at("largest_displacement_mm").get<double>() > 0.075);
        CHECK(up.report->at("largest_displacement_mm").get<double>() <= 0.15);
        CHECK(up.warnings.empty());
        const Outcome down = run("brush-inflate", tube, {{"dabs", stroke(-0.5)}});
        CHECK(down.report->at("volume_change_mm3") < -0.1);
        CHECK(run("brush-inflate", tube, up.resolved).scene.surface->points() ==
              up.scene.surface->points());
    }
    GIVEN("brush-smooth") {
        const Outcome some = run("brush-smooth", tube, {{"dabs", stroke(0.5)}});
        const Outcome more =
            run("brush-smooth", tube, {{"dabs", stroke(0.5)}, {"passes", std::int64_t{40}}});
        CHECK(some.report->at("volume_change_mm3") < 0.0);
        CHECK(more.report->at("largest_displacement_mm") >
              some.report->at("largest_displacement_mm"));
    }
    GIVEN("brush-weight") {
        const Outcome painted = run("brush-weight", tube,
                                    {{"dabs", stroke(0.5)}, {"attribute", std::string("keep_me")}});
        CHECK(painted.report->at("vertices_changed") > 50);
        CHECK(painted.scene.surface->points() == tube.points());
        CHECK(painted.scene.surface->attributes.contains("keep_me"));
        const Outcome erased = run("brush-weight", *painted.scene.surface,
                                   {{"dabs", stroke(-1.0)}, {"attribute", std::string("keep_me")}});
        CHECK(erased.report->at("vertices_above_0") < painted.report->at("vertices_above_0"));
    }
}

SCENARIO("A painted weight survives what changes connectivity", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    const Surface painted =
        *run("brush-weight", tube, {{"dabs", stroke(1.0)}, {"falloff", std::string("constant")}})
             .scene.surface;
    for (const char* name : {"remesh", "subdivide", "smooth"}) {
        INFO(name);
        const Surface after = *run(name, painted, {}).scene.surface;
        REQUIRE(after.attributes.contains("painted_weight"));
        const auto& weights = *after.attributes.at("painted_weight");
        for (std::size_t v = 0; v < after.vertex_count(); ++v) {
            const double away = (after.points()[v] - Vec3(2, 0, 6.5)).norm();
            if (away < 0.7) CHECK(weights[v] > 0.9);
            if (away > 3.0) CHECK(weights[v] < 0.1);
        }
    }
}

SCENARIO("A brush beside the surface and nonsense dabs are refused", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    const auto name = GENERATE("brush-smooth", "brush-inflate", "brush-weight");
    const auto with = [&](std::size_t at, double value) {
        auto numbers = stroke(0.5);
        numbers[at] = value;
        return Arguments{{"dabs", numbers}};
    };
    CHECK_THROWS_AS(run(name, tube, with(9, 4.5)), AlgorithmFailure);
    CHECK_THROWS_WITH(run(name, tube, with(9, 4.5)),
                      Catch::Contains(name) && Catch::Contains("dab 2 at (4.5, 0, 7) mm"));
    CHECK_THROWS_AS(run(name, tube, with(3, -1.0)), AlgorithmFailure);
    CHECK_THROWS_AS(run(name, tube, with(3, 0.0)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(6, 0.0)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(7, -1.0)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(8, 1.5)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(8, std::numeric_limits<double>::quiet_NaN())), UsageError);
    CHECK_THROWS_AS(run(name, tube, {}), UsageError);
    CHECK_THROWS_AS(run(name, tube, {{"dabs", std::vector<double>{1, 2, 3}}}), UsageError);
    CHECK_THROWS_AS(run(name, tube, {{"dabs", std::vector<double>{}}}), UsageError);
    const std::vector<double> between = {2, 0, 6.07, 1, 0, 0, 2, 1e-4, 0.5};
    CHECK_FALSE(run(name, tube, {{"dabs", between}}).warnings.empty());
    CHECK_THROWS_AS(run("brush-smooth", tube, with(8, -0.5)), UsageError);
    CHECK_THROWS_AS(
        run("brush-weight", tube, {{"dabs", stroke(0.5)}, {"attribute", std::string("my weight")}}),
        UsageError);
}

SCENARIO("In a project a stroke is undone, replayed, and stale where its place is gone",
         "[workbench][brush]") {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(closed_tube(2.0, 12.0, 48, 60), file);
    SessionOptions options;
    options.worker.command = {VESSELBENCH_BINARY, "--worker"};
    Session session = Session::unsaved(options);
    const EditId loaded = session.apply("load-surface", {{"file", file}}).edit.edit.id;
    const Positions before = surface_of(session.scene()).points();
    session.apply("brush-inflate", {{"dabs", stroke(1.0)}});
    session.apply("brush-weight", {{"dabs", stroke(1.0)}});
    const Scene brushed = session.scene();
    CHECK(surface_of(brushed).points() != before);
    for (const auto& entry : session.replay()) CHECK(entry.differences.empty());
    session.undo();
    CHECK(surface_of(session.scene()).attributes.empty());
    session.undo();
    CHECK(surface_of(session.scene()).points() == before);
    session.redo();
    session.redo();
    CHECK(*surface_of(session.scene()).attributes.at("painted_weight") ==
          *surface_of(brushed).attributes.at("painted_weight"));
    session.change_edit(loaded, {{"file", file}, {"units", std::string("cm")}});
    static_cast<void>(session.scene());
    CHECK(session.log()[1].status == EditStatus::Stale);
}
