#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"
#include "workbench/suggest/processing_subject.h"
#include "workbench/worker/run_operation.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A ball of 20 mm in slices of 3 mm above its middle, and smooth below.
Surface half_sliced_ball() {
    const auto ball = [](const Vec3& p) {
        const double z = p.z() > 0.0 ? 3.0 * std::floor(p.z() / 3.0) + 1.5 : p.z();
        return Vec3(p.x(), p.y(), z).norm() - 20.03;
    };
    return iso_surface(ball, {Vec3(-22, -22, -22), Vec3(22, 22, 22)}, 0.71);
}

/// Mean distance [mm] of the part inside or outside of what decimate's weights free.
double mean_distance(const nlohmann::ordered_json& figures, const std::string& part) {
    return figures.at("distance_" + part).at("mean_mm");
}

}  // namespace

SCENARIO("smooth keeps caps and rims bit for bit and reports the change", "[workbench][smooth]") {
    const Surface tube = closed_tube(2.0, 12.0, 24, 30);
    const auto filter = GENERATE("laplace", "laplace-hc", "taubin");
    const Outcome outcome = run("smooth", tube, {{"filter", filter}});
    for (TriangleId t = 0; t < tube.triangle_count(); ++t)
        if (tube.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : tube.triangles()[t])
                CHECK(outcome.scene.surface->points()[v] == tube.points()[v]);
    CHECK(outcome.report->at("cap_vertices_kept") == 2 * 24 + 2);
    CHECK(moved_vertices(tube, *outcome.scene.surface) > 0);
    CHECK(outcome.warnings.empty());
}

SCENARIO("smooth warns of values that roughen and refuses a positive mu", "[workbench][smooth]") {
    const Surface tube = closed_tube(2.0, 12.0, 24, 30);
    CHECK_FALSE(
        run("smooth", tube, {{"lambda", 1.0}, {"beta", 0.0}, {"iterations", std::int64_t{1}}})
            .warnings.empty());
    const Outcome taubin = run("smooth", tube, {{"filter", "taubin"}, {"lambda", 0.4}});
    CHECK(taubin.resolved.real("mu") == Approx(-0.408));
    CHECK_THROWS_AS(run("smooth", tube, {{"filter", "taubin"}, {"mu", 0.52}}), UsageError);
    CHECK_THROWS_WITH(run("smooth", tube, {{"filter", "taubin"}, {"mu", -0.1}}),
                      Catch::Contains("mu"));
}

SCENARIO("remesh decides its edges once and replays them", "[workbench][remesh]") {
    const Surface tube = closed_tube(2.0, 20.0, 40, 60);
    const Outcome first = run("remesh", tube, {});
    CHECK(first.resolved.real("edge") == Approx(0.56).epsilon(0.03));
    CHECK(first.report->at("wall").at("equiangle_skewness").at("mean") <= 0.12);
    CHECK(first.report->at("caps").at("radius_ratio").at("mean") > 0.8);
    const Outcome again = run("remesh", tube, first.resolved);
    CHECK(again.scene.surface->points() == first.scene.surface->points());
    CHECK_THROWS_AS(run("remesh", tube, {{"min_edge", 1.0}, {"max_edge", 0.5}}), UsageError);
}

SCENARIO("remesh for a print replays too, and gives way to an edge", "[workbench][remesh]") {
    const Surface tube = closed_tube(2.0, 20.0, 40, 60);
    const Outcome usual = run("remesh", tube, {});
    const Outcome print = run("remesh", tube, {{"print_resolution", 0.1}});
    CHECK(2 * print.scene.surface->triangle_count() < usual.scene.surface->triangle_count());
    CHECK_FALSE(print.resolved.has("edge"));
    const Outcome again = run("remesh", tube, print.resolved);
    CHECK(again.scene.surface->points() == print.scene.surface->points());
    const Outcome asked = run("remesh", tube, {{"print_resolution", 0.1}, {"edge", 0.5}});
    CHECK(asked.resolved.real("print_resolution") == 0.0);
    CHECK(asked.scene.surface->triangle_count() > usual.scene.surface->triangle_count());
}

SCENARIO("remesh refuses edges that lose an opening", "[workbench][remesh]") {
    const Surface tube = mapped(closed_tube(2.0, 20.0, 40, 60), [](const Vec3& p) {
        const double width = std::clamp((20.0 - p.z()) / 8.0, 0.05, 1.0);
        return Vec3(width * p.x(), width * p.y(), p.z());
    });
    CHECK_NOTHROW(run("remesh", tube, {}));
    CHECK_THROWS_WITH(
        run("remesh", tube, {{"edge", 2.5}, {"min_edge", 1.0}}),
        Catch::Contains("too coarse for the opening") && Catch::Contains("0.2 mm wide"));
}

SCENARIO("remesh keeps sharp edges if asked to", "[workbench][remesh]") {
    const Surface box = cube(10.0);
    const auto remeshed = [&](const Arguments& more) {
        Arguments arguments{{"mode", "uniform"}, {"edge", 1.0}, {"radius", "rays"}};
        for (const auto& [name, value] : more.values()) arguments.set(name, value);
        return run("remesh", box, arguments);
    };
    const Outcome kept = remeshed({{"feature_angle", 60.0}});
    CHECK(kept.report->at("feature_edges_kept") == 12);
    CHECK(kept.scene.surface->patches == box.patches);
    CHECK(volume(*kept.scene.surface) == Approx(volume(box)).epsilon(1e-9));
    const Outcome rounded = remeshed({});
    CHECK_FALSE(rounded.report->contains("feature_edges_kept"));
    CHECK(std::abs(volume(*rounded.scene.surface) - volume(box)) > 1e-4 * volume(box));
    THEN("only around regions of a size, if one is given") {
        const Outcome all = remeshed({{"feature_angle", 60.0}, {"feature_size", 99.0}}),
                      none = remeshed({{"feature_angle", 60.0}, {"feature_size", 101.0}});
        CHECK(all.scene.surface->points() == kept.scene.surface->points());
        CHECK(none.report->at("feature_edges_kept") == 0);
        CHECK(none.scene.surface->points() == rounded.scene.surface->points());
    }
}

SCENARIO("print-check calls a model printable only within the printer's limits",
         "[workbench][print]") {
    const Surface tube = fine_tube(0.3, 10.0, 24);
    const Outcome thin = run("print-check", tube, {});
    CHECK(thin.report->at("watertight") == true);
    CHECK(thin.report->at("printable") == false);
    CHECK_THAT(std::string(thin.report->at("headline")),
               Catch::StartsWith("not printable, thinnest place 0.60 mm, below 0.8 mm"));
    CHECK(run("print-check", tube, {{"thinnest", 0.5}}).report->at("printable") == true);
}

SCENARIO("print-check warns of bends too strong for casting", "[workbench][print]") {
    const double leg = 10.0, bend = 2.5, length = 2.0 * leg + bend * std::numbers::pi;
    const Surface hairpin = mapped(fine_tube(1.0, length, 24), [&](const Vec3& p) {
        const double beyond = p.z() - leg, angle = beyond / bend;
        if (beyond < 0.0) return Vec3(bend + p.x(), p.y(), beyond);
        if (angle > std::numbers::pi)
            return Vec3(-bend - p.x(), p.y(), leg + bend * std::numbers::pi - p.z());
        return Vec3((bend + p.x()) * std::cos(angle), p.y(), (bend + p.x()) * std::sin(angle));
    });
    const Outcome tolerated = run("print-check", hairpin, {});
    const double turn = tolerated.report->at("strongest_bend").at("turn_deg");
    CHECK(turn == Approx(2.0 / bend * 180.0 / std::numbers::pi).epsilon(0.1));
    CHECK(tolerated.warnings.empty());
    const Outcome warned = run("print-check", hairpin, {{"bend", 40.0}});
    REQUIRE(warned.warnings.size() == 1);
    CHECK(warned.warnings[0].code == "cast-may-break");
    CHECK(warned.warnings[0].figures.at("turn_deg") == turn);
}

SCENARIO("subdivide splits each triangle into four", "[workbench][subdivide]") {
    const Outcome outcome = run("subdivide", icosphere(5.0, 2), {});
    CHECK(outcome.scene.surface->triangle_count() == 4 * 320);
}

SCENARIO("decimate keeps half of the triangles, or the requested number", "[workbench][decimate]") {
    const Surface sphere = icosphere(5.0, 4);  // 5120 triangles
    const Outcome half = run("decimate", sphere, {});
    CHECK(half.resolved.real("share") == 0.5);
    CHECK(half.scene.surface->triangle_count() == 2560);
    CHECK(half.report->at("distance").at("mean_mm") > 0.0);
    CHECK(volume(*half.scene.surface) == Approx(volume(sphere)).epsilon(0.01));
    CHECK_FALSE(half.report->contains("mean_weight"));
    CHECK(half.warnings.empty());
    CHECK(run("decimate", sphere, {{"triangles", std::int64_t{1000}}})
              .scene.surface->triangle_count() == 1000);
    const Outcome near = run("decimate", sphere, {{"max_error", 0.05}});
    CHECK_FALSE(near.resolved.has("share"));
    CHECK(near.report->at("distance").at("largest_mm") < 0.053);
    CHECK(near.scene.surface->triangle_count() < 1500);
    const Outcome same = run("decimate", sphere, {{"share", 1.0}});
    CHECK(same.scene.surface->points() == sphere.points());
    REQUIRE(same.warnings.size() == 1);
    CHECK(same.warnings.front().code == "nothing-to-decimate");
}

SCENARIO("decimate refuses arguments that make no sense", "[workbench][decimate]") {
    const Surface sphere = icosphere(5.0, 2);
    CHECK_THROWS_AS(run("decimate", sphere, {{"share", 0.5}, {"triangles", std::int64_t{100}}}),
                    UsageError);
    CHECK_THROWS_AS(run("decimate", sphere, {{"share", 0.0}}), UsageError);
    CHECK_THROWS_AS(run("decimate", sphere, {{"share", 1.5}}), UsageError);
    CHECK_THROWS_AS(run("decimate", sphere, {{"triangles", std::int64_t{0}}}), UsageError);
    CHECK_THROWS_AS(run("decimate", sphere, {{"max_error", 0.0}}), UsageError);
    CHECK_THROWS_WITH(run("decimate", sphere, {{"distance", "linear"}}),
                      Catch::Contains("load-neighbour"));
    CHECK_THROWS_WITH(run("decimate", sphere, {{"painted", "none"}}), Catch::Contains("'none'"));
    CHECK_THROWS_AS(run("decimate", sphere, {{"staircase", true}, {"stack_axis", Vec3(0, 0, 0)}}),
                    UsageError);
}

SCENARIO("decimate removes triangles far from a neighbour, and reports the gain",
         "[workbench][decimate]") {
    Scene scene;
    scene.surface = icosphere(10.0, 4);
    scene.neighbours["bone"] = icosphere(2.0, 2, Vec3(0, 0, 13));
    const Outcome outcome = run("decimate", scene, {{"share", 0.25}, {"distance", "linear"}});
    const auto& report = *outcome.report;
    CHECK(outcome.resolved.text("neighbours") == "bone");
    CHECK(mean_distance(report, "outside") < mean_distance(report.at("unweighted"), "outside"));
    CHECK(report.at("unweighted").at("triangles") == outcome.scene.surface->triangle_count());
    const Outcome again = run("decimate", scene, outcome.resolved);
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
}

SCENARIO("decimate spends its error on staircases", "[workbench][decimate]") {
    const Surface stairs = half_sliced_ball();
    const auto [share, most] =
        GENERATE(table<double, double>({{0.25, 0.0072}, {0.1, 0.023}, {0.05, 0.053}}));
    const Arguments arguments{{"share", share},
                              {"staircase", true},
                              {"tau_theta", 0.5},
                              {"tau_max", 3.0},
                              {"stack_axis", Vec3(0, 0, 1)}};
    const Outcome outcome = run("decimate", stairs, arguments);
    const auto &report = *outcome.report, &plain = report.at("unweighted");
    CAPTURE(share, report.dump());
    CHECK(plain.at("triangles") == outcome.scene.surface->triangle_count());
    CHECK(mean_distance(report, "outside") < 0.85 * mean_distance(plain, "outside"));
    CHECK(mean_distance(report, "inside") < most);
}

SCENARIO("decimate reports weights that gain nothing", "[workbench][decimate]") {
    Surface sphere = icosphere(10.0, 3);
    std::vector<double> paint;
    for (const Vec3& p : sphere.points()) paint.push_back(p.z() > 9.0 ? 1.0 : 0.0);
    sphere.attributes["paint"] = std::make_shared<const std::vector<double>>(std::move(paint));
    const auto warned = [&](double share) {
        const Outcome outcome = run("decimate", sphere, {{"share", share}, {"painted", "paint"}});
        const bool worse = mean_distance(*outcome.report, "outside") >
                           1.05 * mean_distance(outcome.report->at("unweighted"), "outside");
        const bool told =
            std::ranges::count(outcome.warnings, "weights-gain-nothing", &Diagnostic::code) > 0;
        CHECK(told == worse);
        return told;
    };
    CHECK_FALSE(warned(0.97));
    CHECK(warned(0.25));
}

SCENARIO("decimate says why nothing was removed", "[workbench][decimate]") {
    Scene scene;
    scene.surface = icosphere(10.0, 3);
    scene.neighbours["bone"] = icosphere(2.0, 2, Vec3(0, 0, 13));
    const auto warning = [&](const Arguments& arguments) {
        const Outcome outcome = run("decimate", scene, arguments);
        REQUIRE(outcome.warnings.size() == 1);
        return outcome.warnings.front();
    };
    const Arguments beyond{{"max_error", 0.5}, {"distance", "margin"}, {"margin", 100.0}};
    CHECK(warning(beyond).code == "all-triangles-kept");
    CHECK(warning(beyond).figures.at("margin_mm") == 100.0);
    CHECK(warning({{"max_error", 1e-9}}).remedies ==
          std::vector<Remedy>{{.arguments = {{"max_error", ""}}}});
    Arguments smooth{
        {"max_error", 0.5}, {"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}, {"beta_min", 0.0}};
    CHECK(warning(smooth).code == "all-triangles-kept");
    CHECK(warning(smooth).figures.at("tau_theta") == 0.5);
    smooth.set("beta_min", 0.3);
    CHECK(warning(smooth).code == "no-staircases");
}

SCENARIO("decimate reports what kept it from its target", "[workbench][decimate]") {
    const Surface shell = sphere_shell(10.0, 0.03, 4);
    const Outcome outcome = run("decimate", shell, {{"share", 0.05}});
    REQUIRE_FALSE(outcome.warnings.empty());
    CHECK(outcome.warnings.front().code == "fewer-would-cross");
    const Outcome least = run("decimate", icosphere(5.0, 3), {{"share", 0.001}});
    REQUIRE(least.warnings.size() == 1);
    CHECK(least.warnings.front().code == "fewer-would-fold");
}

SCENARIO("decimate reports missed targets", "[workbench][decimate]") {
    for (const char* name : {"margin", "painted"}) {
        CHECK_THAT(find_parameter(find_operation("decimate"), name).help,
                   Catch::Contains("are decimated last, and not at all with max_error"));
        CHECK_THAT(find_parameter(find_operation("smooth"), name).help,
                   Catch::Contains("do not move"));
    }
}

SCENARIO("decimate splits the surface into the same parts for any beta_min",
         "[workbench][decimate]") {
    const Surface stairs = half_sliced_ball();
    const auto unweighted = [&](double beta_min) {
        const auto report = *run("decimate", stairs,
                                 {{"share", 0.1},
                                  {"staircase", true},
                                  {"tau_theta", 0.5},
                                  {"beta_min", beta_min},
                                  {"stack_axis", Vec3(0, 0, 1)}})
                                 .report;
        return mean_distance(report.at("unweighted"), "inside");
    };
    CHECK(unweighted(0.1) == Approx(unweighted(0.5)).epsilon(1e-9));
}

SCENARIO("a search decimates once where the operation compares with a run without weights",
         "[workbench][decimate]") {
    Scene scene;
    scene.surface = icosphere(10.0, 3);
    scene.neighbours["bone"] = icosphere(2.0, 2, Vec3(0, 0, 13));
    const Operation& operation = find_operation("decimate");
    const Arguments given{{"distance", "linear"}};
    std::vector<std::string> done;
    Progress progress([&](double, std::string_view what) { done.emplace_back(what); }, {});
    const SearchSpace space = processing_space(operation, *scene.surface, given, false);
    const Surface found = processed_with(operation, scene, given, space, {0.25}, progress);
    const std::string comparing = "decimating without weights, for comparison";
    CHECK(std::ranges::count(done, "decimating") > 0);
    CHECK(std::ranges::count(done, comparing) == 0);
    Arguments same = given;
    same.set("share", 0.25);
    const Outcome whole =
        run_operation(operation, scene, checked_arguments(operation, same), progress);
    CHECK(std::ranges::count(done, comparing) == 1);
    CHECK(whole.scene.surface->points() == found.points());
}

SCENARIO("decimate estimates the stack axis once, and replays it", "[workbench][decimate]") {
    const Surface vessel = of_mask(vessel_in_slices());
    const Outcome outcome = run("decimate", vessel, {{"share", 0.1}, {"staircase", true}});
    CHECK(outcome.resolved.has("stack_axis"));
    CHECK(run("decimate", vessel, outcome.resolved).scene.surface->points() ==
          outcome.scene.surface->points());
}
