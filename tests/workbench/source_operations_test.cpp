#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

namespace {

Outcome run(const std::string& name, const Scene& scene, const Arguments& arguments) {
    Progress progress;
    const Operation& operation = find_operation(name);
    return operation.run(scene, checked_arguments(operation, arguments), progress);
}

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

}  // namespace

SCENARIO("load-surface reports its decision about the unit", "[workbench][source]") {
    const std::string file = temporary_folder() + "/tube.off";
    write_surface(open_tube(2.0, 30.0, 24, 20), file);
    const Outcome stated = run("load-surface", {}, {{"file", file}});
    CHECK(stated.resolved.text("units") == "mm");
    CHECK(stated.report->at("file") == "tube.off");
    CHECK(stated.report->at("boundary_loops") == 2);
    const Outcome given = run("load-surface", {}, {{"file", file}, {"units", "cm"}});
    CHECK(given.report->at("size_mm")[2].get<double>() == Approx(300.0));
    CHECK_THROWS_AS(run("load-surface", {}, {{"file", file}, {"units", "inch"}}), UsageError);
    CHECK_THROWS_AS(run("load-surface", {}, {}), UsageError);
    CHECK_THROWS_AS(run("load-surface", {}, {{"file", "absent.stl"}}), IoError);
}

SCENARIO("load-surface asks where two units are near", "[workbench][source]") {
    const std::string file = temporary_folder() + "/trunk.off";
    // A thin artery in mm, or a pulmonary trunk in cm.
    write_unitless(open_tube(1.0, 12.0, 24, 40), file);
    CHECK_THROWS_WITH(run("load-surface", {}, {{"file", file}}),
                      Contains("in mm it is 12.3 mm long") && Contains("in cm it is 123 mm long") &&
                          Contains("--units mm or --units cm"));
    CHECK_THROWS_AS(run("load-surface", {}, {{"file", file}}), UsageError);
    const Outcome guessed = run("load-surface", {}, {{"file", file}, {"units", "guess"}});
    CHECK(guessed.resolved.text("units") == "mm");
    REQUIRE(guessed.warnings.size() == 1);
    CHECK(guessed.warnings[0].code == "unit-guessed");
    CHECK_THAT(guessed.warnings[0].words.at("doubt"), Contains("in cm it is 123 mm long"));
    CHECK(run("load-surface", {}, {{"file", file}, {"units", "cm"}}).warnings.empty());
}

SCENARIO("load-surface warns of a unit in which it is no vessel", "[workbench][source]") {
    const std::string file = temporary_folder() + "/tube.off";
    write_unitless(open_tube(2.0, 30.0, 24, 20), file);
    const auto warnings = [&](const std::string& units) {
        return run("load-surface", {}, {{"file", file}, {"units", units}}).warnings;
    };
    CHECK(warnings("mm").empty());
    REQUIRE(warnings("m").size() == 1);
    const Diagnostic unlikely = warnings("m")[0];
    CHECK(unlikely.code == "unit-unlikely");
    CHECK(unlikely.words.at("units") == "m");
    CHECK(unlikely.words.at("likely") == "mm");
}

SCENARIO("keep-component keeps the largest part, several, or the one at a point",
         "[workbench][source]") {
    const Scene scene =
        scene_of(merged(merged(icosphere(1.0, 1), icosphere(2.0, 2, Vec3(10, 0, 0))),
                        icosphere(1.0, 0, Vec3(20, 0, 0))));
    CHECK(run("keep-component", scene, {}).scene.surface->triangle_count() == 320);
    CHECK(run("keep-component", scene, {{"count", std::int64_t{2}}})
              .scene.surface->triangle_count() == 400);
    const Outcome chosen = run("keep-component", scene, {{"seed", Vec3(21, 0, 0)}});
    CHECK(chosen.scene.surface->triangle_count() == 20);
    CHECK(chosen.report->at("components_before") == 3);
    CHECK_THROWS_AS(run("keep-component", {}, {}), AlgorithmFailure);
}

SCENARIO("repair lists its actions, and its replay gives the same bits", "[workbench][source]") {
    const Scene scene = scene_of(merged(flipped(icosphere(5.0, 3)), icosphere(0.2, 0)));
    const Outcome outcome = run("repair", scene, {});
    CHECK(is_closed_manifold(*outcome.scene.surface));
    CHECK(enclosed_volume(*outcome.scene.surface) > 0.0);
    CHECK(outcome.report->at("turned_inside_out") == true);
    CHECK(outcome.report->at("removed_components") == 1);
    CHECK(outcome.report->at("places").at("component").size() == 1);
    CHECK_FALSE(outcome.warnings.empty());
    const Scene broken = scene_of(
        merged(fine_tube(2.0, 30.0, 48), mapped(closed_tube(0.3, 6.0, 6, 4), [](const Vec3& p) {
                   return Vec3(p.x() + 9.0, p.y(), p.z());
               })));
    const Outcome lost = run("repair", broken, {});
    REQUIRE(lost.warnings.size() == 1);
    CHECK(lost.warnings[0].code == "vessel-removed");
    CHECK(lost.warnings[0].place->x() == Approx(9.0).margin(0.5));
    CHECK(lost.warnings[0].remedies ==
          std::vector<Remedy>{{.arguments = {{"keep_components", "2"}}}});
    CHECK(run("repair", broken, {{"keep_components", std::int64_t{2}}}).warnings.empty());
    const Outcome again = run("repair", scene, outcome.resolved);
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
}
