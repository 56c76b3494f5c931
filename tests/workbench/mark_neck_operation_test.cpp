#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/sac_on_tube.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/batch/case_report.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;
using Json = nlohmann::ordered_json;

namespace {

Outcome marked(const Surface& surface, const Arguments& arguments = {}) {
    return run("mark-neck", surface, arguments);
}

/// Figures that do not depend on the vessel's place, direction or triangles.
const std::vector<std::string> kFigures = {
    "dome_area_mm2", "neck_area_mm2", "volume_mm3",  "neck_diameter_mm",  "height_mm",
    "width_mm",      "aspect_ratio",  "size_ratio",  "bottleneck_factor", "ellipticity",
    "nonsphericity", "length_mm",     "diameter_mm", "neck_width_mm",     "parent_diameter_mm"};

void check_same_figures(const Json& a, const Json& b, double factor = 1.0) {
    for (const std::string& name : kFigures) {
        CAPTURE(name);
        const double dimension = name.ends_with("_mm3")   ? 3.0
                                 : name.ends_with("_mm2") ? 2.0
                                 : name.ends_with("_mm")  ? 1.0
                                                          : 0.0;
        CHECK(b.at(name).get<double>() ==
              Approx(std::pow(factor, dimension) * a.at(name).get<double>()).epsilon(0.005));
    }
}

/// The same shape with four times as many triangles.
Surface split_in_four(const Surface& surface) {
    Positions points = surface.points();
    std::map<std::pair<VertexId, VertexId>, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
        const auto [found, added] =
            middles.try_emplace(std::minmax(a, b), static_cast<VertexId>(points.size()));
        if (added) points.push_back(0.5 * (points[a] + points[b]));
        return found->second;
    };
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : surface.triangles()) {
        const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        triangles.insert(triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return make_surface(std::move(points), std::move(triangles));
}

Json program_json(std::vector<std::string> words) {
    words.emplace_back("--json");
    const ProgramRun done = run_program(program_path(), words);
    INFO(done.err);
    REQUIRE(done.exit_code == 0);
    return Json::parse(done.out);
}

}  // namespace

SCENARIO("mark-neck finds the sac, stores its neck's plane and moves nothing", "[workbench][sac]") {
    const Surface surface = sac_on_tube(0.15);
    const Outcome outcome = marked(surface);
    CHECK(outcome.warnings.empty());
    CHECK(outcome.scene.surface->points() == surface.points());
    CHECK(outcome.scene.surface->topology == surface.topology);
    CHECK((outcome.resolved.point("dome") - sac_dome()).norm() < kSacRadius);
    const Vec3 at = outcome.resolved.point("at");
    CHECK(at.z() == Approx(kSacTube).margin(0.15));
    CHECK(outcome.resolved.point("normal").z() > std::cos(3.0 * std::numbers::pi / 180.0));
    const Json& report = *outcome.report;
    THEN("its figures are those of the sphere above that plane") {
        const SphereAbove sphere = sphere_above(at.z());
        CHECK(report.at("height_mm").get<double>() == Approx(sphere.height).epsilon(0.01));
        CHECK(report.at("volume_mm3").get<double>() == Approx(sphere.volume).epsilon(0.01));
        CHECK(report.at("dome_area_mm2").get<double>() == Approx(sphere.dome_area).epsilon(0.01));
        CHECK(report.at("parent_diameter_mm").get<double>() ==
              Approx(2.0 * kSacTube).epsilon(0.01));
        CHECK_THAT(report.at("headline").get<std::string>(),
                   Contains("neck") && Contains("aspect ratio"));
        CHECK(report.at("regions").size() == 2);
        CHECK(report.at("vessels").size() == 2);
    }
    THEN("its decisions give the same figures, bit for bit") {
        const Outcome again = marked(surface, outcome.resolved);
        CHECK(*again.report == report);
        CHECK(again.resolved == outcome.resolved);
    }
    THEN("a form shows them before a run") {
        const Operation& operation = find_operation("mark-neck");
        Scene scene;
        scene.surface = surface;
        const Arguments decided = operation.decided(scene, checked_arguments(operation, {}), {});
        CHECK(decided.values() == outcome.resolved.values());
    }
}

SCENARIO("mark-neck takes a given plane as it is", "[workbench][sac]") {
    const double side = GENERATE(1.0, -2.0);
    const Outcome outcome =
        marked(sac_on_tube(0.15),
               {{"dome", sac_dome()}, {"at", Vec3(0.7, 0.2, 2.2)}, {"normal", Vec3(0, 0, side)}});
    const SphereAbove sphere = sphere_above(2.2);
    const Json& report = *outcome.report;
    CHECK(outcome.resolved.point("normal") == Vec3(0, 0, side));
    CHECK(report.at("height_mm").get<double>() == Approx(sphere.height).epsilon(0.005));
    CHECK(report.at("neck_diameter_mm").get<double>() ==
          Approx(2.0 * sphere.neck_radius).epsilon(0.01));
    CHECK(report.at("aspect_ratio").get<double>() ==
          Approx(0.5 * sphere.height / sphere.neck_radius).epsilon(0.01));
    CHECK(report.at("bottleneck_factor").get<double>() ==
          Approx(kSacRadius / sphere.neck_radius).epsilon(0.01));
}

SCENARIO("The figures of a sac do not depend on direction, unit and triangles",
         "[workbench][sac]") {
    const Json report = *marked(sac_on_tube(0.15)).report;
    THEN("rotated") {
        const Eigen::Matrix3d turn = skew_rotation();
        const Surface turned =
            mapped(sac_on_tube(0.15), [&](const Vec3& x) { return Vec3(turn * x); });
        check_same_figures(report, *marked(turned).report);
    }
    THEN("ten times as large") {
        const Surface large =
            mapped(sac_on_tube(0.15), [](const Vec3& x) { return Vec3(10.0 * x); });
        check_same_figures(report, *marked(large).report, 10.0);
    }
    THEN("with four times as many triangles") {
        check_same_figures(report, *marked(split_in_four(sac_on_tube(0.15))).report);
    }
}

SCENARIO("mark-neck leaves out the figures of a neck that is in doubt", "[workbench][sac]") {
    // The plane cuts obliquely, and wall lies far beside the part that it takes.
    const Arguments oblique = {
        {"dome", sac_dome()}, {"at", Vec3(0, 0, kSacMiddle + 1.2)}, {"normal", Vec3(0, 0, 1)}};
    const Outcome doubtful = marked(sac_on_tube(0.15), oblique);
    REQUIRE(doubtful.warnings.size() == 1);
    CHECK(doubtful.warnings[0].code == "neck-in-doubt");
    CHECK(doubtful.report->at("in_doubt") == true);
    CHECK_FALSE(doubtful.report->contains("height_mm"));
    Arguments accepted = oblique;
    accepted.set("accept_doubt", true);
    const Outcome wanted = marked(sac_on_tube(0.15), accepted);
    CHECK(wanted.warnings.empty());
    CHECK(wanted.report->at("height_mm").get<double>() == Approx(1.302).epsilon(0.01));
}

SCENARIO("mark-neck refuses what marks no neck in one clear line", "[workbench][sac]") {
    const Surface surface = sac_on_tube(0.15);
    const Vec3 above = sac_dome() + Vec3(0, 0, 1), up = Vec3::UnitZ();
    CHECK_THROWS_WITH(marked(surface, {{"at", Vec3(0, 0, 2)}, {"normal", Vec3(0, 0, 0)}}),
                      Contains("normal must not be 0,0,0"));
    CHECK_THROWS_WITH(marked(surface, {{"at", Vec3(0, 0, 2)}}),
                      Contains("give both at and normal, or neither"));
    CHECK_THROWS_WITH(marked(surface, {{"normal", up}}),
                      Contains("give both at and normal, or neither"));
    for (const Vec3& at : {above, Vec3(0, 0, -1)})
        CHECK_THROWS_WITH(marked(surface, {{"dome", sac_dome()}, {"at", at}, {"normal", up}}),
                          Contains("does not separate the sac"));
    CHECK_THROWS_WITH(marked(closed_tube(1.75, 18.0, 24, 60)),
                      Contains("no blind end is likely to be a sac") && Contains("dome"));
    const Surface two =
        merged(surface, mapped(surface, [](const Vec3& x) { return Vec3(x + Vec3(0, 30, 0)); }));
    CHECK_THROWS_WITH(marked(two),
                      Contains("2 blind ends are likely to be sacs") && Contains("(sac "));
}

SCENARIO("A project's sac is measured on the model, whatever its triangles", "[workbench][sac]") {
    const std::string folder = temporary_folder(), project = folder + "/sac.vbench";
    write_surface(sac_on_tube(0.2), folder + "/sac.vtp");
    program_json({"new", project, folder + "/sac.vtp", "--units", "mm"});
    CHECK_FALSE(program_json({"measure", project}).contains("sac"));
    program_json({"apply", project, "mark-neck", "at=0,0,1.9", "normal=0,0,1"});
    CHECK(program_json({"log", project})["edits"][1]["variant"] == "");
    const SphereAbove sphere = sphere_above(1.9);
    const auto check_sac = [&] {
        const Json measured = program_json({"measure", project});
        REQUIRE(measured.contains("sac"));
        const Json& sac = measured["sac"];
        CHECK(sac["height"].get<double>() == Approx(sphere.height).epsilon(0.01));
        CHECK(sac["volume"].get<double>() == Approx(sphere.volume).epsilon(0.02));
        CHECK(sac["aspect_ratio"].get<double>() ==
              Approx(0.5 * sphere.height / sphere.neck_radius).epsilon(0.02));
        CHECK(sac["regions"].size() == 2);
    };
    check_sac();
    program_json({"apply", project, "remesh", "mode=uniform", "edge=0.25", "--variant", "rp"});
    check_sac();
    THEN("it is undone and replayed like any edit") {
        CHECK(program_json({"replay", project})["same"] == true);
        program_json({"undo", project, "2"});
        CHECK_FALSE(program_json({"measure", project}).contains("sac"));
        program_json({"redo", project, "2"});
        check_sac();
    }
    THEN("a model without the sac says so, and is measured") {
        program_json({"apply", project, "remove-branch", "tip=0,0,6"});
        const ProgramRun done = run_program(program_path(), {"measure", project, "--json"});
        CHECK(done.exit_code == 0);
        CHECK_THAT(done.err, Contains("not measured on this model"));
        CHECK_FALSE(Json::parse(done.out).contains("sac"));
    }
}

SCENARIO("Reports and tables of a batch have the figures of a marked sac", "[workbench][sac]") {
    const std::string folder = temporary_folder();
    write_surface(sac_on_tube(0.2), folder + "/sac.vtp");
    write_text(folder + "/recipe.json",
               R"([{"operation": "repair"}, {"operation": "mark-neck"},)"
               R"( {"operation": "subdivide"}, {"operation": "print-check"}])");
    program_json({"prepare", folder + "/sac.vtp", "--units", "mm", "--for", "rp", "--recipe",
                  folder + "/recipe.json", "--out", folder + "/out"});
    const Json report = Json::parse(file_content(folder + "/out/report.json"));
    REQUIRE(report.contains("sac"));
    CHECK(report["sac"]["height_mm"].get<double>() ==
          Approx(sphere_above(kSacTube).height).epsilon(0.02));
    CHECK_THAT(file_content(folder + "/out/report.html"),
               Contains("measured on this model") && Contains("bottleneck factor"));
    std::size_t found = 0;
    for (const TableFigure& figure : table_figures())
        if (figure.pointer.starts_with("/sac/")) {
            CAPTURE(figure.name);
            CHECK(figure_in(report, figure).is_number());
            ++found;
        }
    CHECK(found == 16);
}
