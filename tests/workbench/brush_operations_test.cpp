#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/nasty_shapes.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Two dabs on the wall of a tube of radius 2 mm along z, as a flat list.
std::vector<double> stroke(double strength, double falloff = 1.0) {
    return {2, 0, 6, 1, 0, 0, 2, 1.5, strength, falloff,
            2, 0, 7, 1, 0, 0, 2, 1.5, strength, falloff};
}

}  // namespace

SCENARIO("The brushes report what they did and replay it", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    GIVEN("brush-inflate") {
        const Outcome up = run("brush-inflate", tube, {{"dabs", stroke(0.5)}});
        CHECK(up.report->at("dabs") == 2);
        const Surface& lifted = *up.scene.surface;
        CHECK(moved_vertices(tube, lifted) > 50);
        CHECK(up.report->at("volume_change_mm3") > 0.1);
        CHECK(longest_way(tube, lifted) > 0.075);
        CHECK(longest_way(tube, lifted) <= 0.15);
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
        CHECK(longest_way(tube, *more.scene.surface) > longest_way(tube, *some.scene.surface));
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

SCENARIO("A dab at a point is stored as the resolved dab", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    const auto name = GENERATE("brush-smooth", "brush-inflate", "brush-weight");
    const Arguments given = {{"at", Vec3(2.4, 0.1, 6.0)}, {"radius", 1.5}, {"falloff", 0.5}};
    const Outcome outcome = run(name, tube, given);
    CHECK(outcome.warnings.empty());
    const Records& dabs = outcome.resolved.records("dabs");
    REQUIRE(dabs.list().size() == 1);
    const Arguments& dab = dabs.list()[0];
    CHECK((dab.point("point") - Vec3(2.0, 0.1, 6.0)).norm() < 0.03);
    CHECK(dab.point("normal").x() > 0.99);
    CHECK(dab.real("vessel_radius") == Approx(2.0).epsilon(0.01));
    CHECK(dab.real("radius") == 1.5);
    CHECK(dab.real("strength") == 0.5);
    CHECK(dab.real("falloff") == 0.5);
    THEN("its replay and the dab alone are the same bits") {
        const Outcome again = run(name, tube, outcome.resolved);
        const Outcome alone = run(name, tube, {{"dabs", dabs}});
        CHECK(again.resolved == outcome.resolved);
        for (const Outcome* other : {&again, &alone}) {
            CHECK(other->scene.surface->points() == outcome.scene.surface->points());
            if (std::string(name) == "brush-weight")
                CHECK(*other->scene.surface->attributes.at("painted_weight") ==
                      *outcome.scene.surface->attributes.at("painted_weight"));
        }
    }
    THEN("a point away from the surface causes a warning") {
        const Outcome off = run(name, tube, {{"at", Vec3(8, 0, 6)}, {"radius", 1.5}});
        REQUIRE(off.warnings.size() == 1);
        CHECK(off.warnings[0].code == "dab-off-surface");
        CHECK(off.warnings[0].figures.at("distance_mm") == Approx(6.0).epsilon(0.01));
        CHECK_THROWS_AS(run(name, tube, {{"at", Vec3(80, 0, 6)}, {"radius", 1.5}}),
                        AlgorithmFailure);
    }
}

SCENARIO("A brush does not push a wall through another one", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    const Surface both =
        merged(tube, mapped(tube, [](const Vec3& p) { return Vec3(p + Vec3(4.1, 0, 0)); }));
    const Outcome outcome =
        run("brush-inflate", both, {{"at", Vec3(2, 0, 6)}, {"radius", 2.0}, {"strength", 1.0}});
    REQUIRE(outcome.warnings.size() == 1);
    CHECK(outcome.warnings[0].code == "brush-crosses-walls");
    CHECK(self_intersections(*outcome.scene.surface).empty());
    CHECK(moved_vertices(both, *outcome.scene.surface) > 20);
}

SCENARIO("A painted weight controls smooth, and undo and replay give the same bits",
         "[workbench][brush]") {
    const std::string file = temporary_folder() + "/tube.vtp";
    const Surface tube = mapped(closed_tube(2.0, 12.0, 48, 60), [](const Vec3& p) {
        return Vec3(p.x() * (1.0 + 0.03 * std::sin(7.0 * p.z())), p.y(), p.z());
    });
    write_surface(tube, file);
    const std::string project = temporary_folder() + "/p.vbench";
    SessionOptions options{.find = find_operation};
    options.worker.command = {test::program_path(), "--worker"};
    Positions painted_points;
    {
        Session session = Session::create(project, options);
        session.apply("load-surface", {{"file", file}});
        session.apply("brush-weight", {{"at", Vec3(2, 0, 6)}, {"radius", 2.0}, {"strength", 1.0}});
        session.apply("smooth", {{"filter", "laplace"}, {"painted", "painted_weight"}});
        painted_points = surface_of(session.scene()).points();
        session.undo();
        const Surface before = surface_of(session.scene());
        const auto& weights = *before.attributes.at("painted_weight");
        std::size_t moved = 0;
        for (std::size_t v = 0; v < weights.size(); ++v) {
            const bool went = painted_points[v] != before.points()[v];
            if (weights[v] == 0.0) REQUIRE_FALSE(went);
            moved += went ? 1 : 0;
        }
        CHECK(moved > 50);
        session.redo();
        CHECK(surface_of(session.scene()).points() == painted_points);
        for (const auto& entry : session.replay()) CHECK(entry.differences.empty());
    }
    THEN("also from the file, with another stroke before it") {
        Session session = Session::open(project, options);
        CHECK(surface_of(session.scene()).points() == painted_points);
        for (const auto& entry : session.replay()) {
            CHECK((entry.replayed || entry.operation == "load-surface"));  // its file is elsewhere
            CHECK(entry.differences.empty());
        }
        const EditId stroke = session.log()[1].edit.edit.id;
        session.change_edit(stroke, {{"at", Vec3(-2, 0, 6)}, {"radius", 2.0}, {"strength", 1.0}});
        CHECK(surface_of(session.scene()).points() != painted_points);
        session.undo();
        CHECK(surface_of(session.scene()).points() == painted_points);
    }
}

SCENARIO("A painted weight survives changes of connectivity", "[workbench][brush]") {
    const Surface tube = closed_tube(2.0, 12.0, 48, 60);
    const Surface painted = *run("brush-weight", tube, {{"dabs", stroke(1.0, 0.0)}}).scene.surface;
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
    CHECK_THROWS_AS(run(name, tube, with(10, 4.5)), AlgorithmFailure);
    CHECK_THROWS_WITH(run(name, tube, with(10, 4.5)),
                      Catch::Contains(name) && Catch::Contains("dab 2 at (4.5, 0, 7) mm"));
    CHECK_THROWS_AS(run(name, tube, with(3, -1.0)), AlgorithmFailure);
    CHECK_THROWS_AS(run(name, tube, with(3, 0.0)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(6, 0.0)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(7, -1.0)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(8, 1.5)), UsageError);
    CHECK_THROWS_AS(run(name, tube, with(8, std::numeric_limits<double>::quiet_NaN())), UsageError);
    CHECK_THROWS_WITH(run(name, tube, with(19, 1.1)),
                      Catch::Contains(name) &&
                          Catch::Contains("'dabs', record 2, field 'falloff' = '1.1'") &&
                          Catch::Contains("0 to 1"));
    CHECK_THROWS_WITH(run(name, tube, {}), Catch::Contains("give dabs, or at=x,y,z"));
    CHECK_THROWS_AS(run(name, tube, {{"at", Vec3(2, 0, 6)}}), UsageError);
    CHECK_THROWS_AS(run(name, tube, {{"dabs", stroke(0.5)}, {"radius", 1.0}}), UsageError);
    CHECK_THROWS_AS(run(name, tube, {{"dabs", stroke(0.5)}, {"at", Vec3(2, 0, 6)}}), UsageError);
    CHECK_THROWS_WITH(run(name, tube, {{"at", Vec3(2, 0, 6)}, {"radius", 0.0}}),
                      Catch::Contains("'radius'") && Catch::Contains("above 0 mm"));
    CHECK_THROWS_WITH(run(name, tube, {{"at", Vec3(2, 0, 6)}, {"radius", 1e6}}),
                      Catch::Contains("radius = 1e+06") && Catch::Contains("give at most"));
    CHECK_THROWS_WITH(run(name, tube, with(17, 1e6)),
                      Catch::Contains("dab 2 at (2, 0, 7) mm: its radius = 1e+06") &&
                          Catch::Contains("give at most"));
    CHECK_NOTHROW(run(name, tube, with(17, 100.0)));
    CHECK_THROWS_WITH(run(name, tube, {{"at", Vec3(2, 0, 6)}, {"radius", 1.0}, {"falloff", -1.0}}),
                      Catch::Contains("'falloff'") && Catch::Contains("0 to 1"));
    CHECK_THROWS_AS(run(name, tube, {{"dabs", std::vector<double>{1, 2, 3}}}), UsageError);
    CHECK_THROWS_AS(run(name, tube, {{"dabs", std::vector<double>{}}}), UsageError);
    const std::vector<double> between = {2, 0, 6.07, 1, 0, 0, 2, 1e-4, 0.5, 1};
    CHECK_FALSE(run(name, tube, {{"dabs", between}}).warnings.empty());
    CHECK_THROWS_AS(run("brush-smooth", tube, with(8, -0.5)), UsageError);
    CHECK_THROWS_AS(
        run("brush-weight", tube, {{"dabs", stroke(0.5)}, {"attribute", std::string("my weight")}}),
        UsageError);
}

SCENARIO("Brushes accept any shape, or say why not", "[workbench][brush]") {
    const auto name = GENERATE(as<std::string>(), "brush-smooth", "brush-inflate", "brush-weight");
    std::size_t brushed = 0;
    for (const auto& [shape, surface] : nasty_shapes()) {
        CAPTURE(shape);
        const double extent = bounds(surface).diagonal(), size = extent > 0.0 ? extent : 1e-3;
        const Arguments arguments = {{"at", surface.points()[surface.triangles()[0][0]]},
                                     {"radius", size},
                                     {"strength", 0.8}};
        try {
            const Outcome outcome = run(name, surface, arguments);
            const auto finite = [](const Vec3& p) { return p.allFinite(); };
            CHECK(std::ranges::all_of(outcome.scene.surface->points(), finite));
            CHECK((run(name, surface, outcome.resolved).scene.surface->points() ==
                   outcome.scene.surface->points()));
            ++brushed;
        } catch (const AlgorithmFailure& failure) {
            CHECK_THAT(failure.what(), Catch::Contains("has no area"));
        }
    }
    CHECK(brushed >= nasty_shapes().size() - 4);  // the others have no area at all
}

SCENARIO("In a project a stroke is undone, replayed, and stale if its place is gone",
         "[workbench][brush]") {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(closed_tube(2.0, 12.0, 48, 60), file);
    SessionOptions options{.find = find_operation};
    options.worker.command = {test::program_path(), "--worker"};
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
    CHECK(session.log()[1].status == EditStatus::Done);  // it is scaled with the model
    const std::string far = temporary_folder() + "/far.vtp";
    write_surface(mapped(closed_tube(2.0, 12.0, 48, 60),
                         [](const Vec3& p) { return Vec3(p + Vec3(50, 0, 0)); }),
                  far);
    session.change_edit(loaded, {{"file", far}});
    static_cast<void>(session.scene());
    CHECK(session.log()[1].status == EditStatus::Stale);
}
