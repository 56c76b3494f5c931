#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "tests/support/posing_phantoms.h"
#include "tests/support/shapes.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

Outcome applied(const std::string& name, const Scene& scene, const Arguments& arguments) {
    Progress progress;
    const Operation& operation = find_operation(name);
    return operation.run(scene, checked_arguments(operation, arguments), progress);
}

}  // namespace

SCENARIO("deform-branch stores the reach it decides and repeats itself", "[workbench][posing]") {
    const Scene scene = scene_of(fine_tube(2.0, 60.0, 24));
    const Arguments given = {{"at", Vec3(2, 0, 35)}, {"move", Vec3(2, 0, 0)}};
    const Outcome outcome = applied("deform-branch", scene, given);
    CHECK(outcome.resolved.real("reach") == Approx(16.0).epsilon(0.05));
    CHECK(outcome.report->at("largest_shift_mm").get<double>() > 1.9);
    CHECK(outcome.report->at("sharpest_bend_radii").get<double>() > 1.2);
    const Outcome again = applied("deform-branch", scene, outcome.resolved);
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
}

SCENARIO("deform-branch without anything to do says what to give", "[workbench][posing]") {
    const Scene scene = scene_of(fine_tube(2.0, 60.0, 24));
    CHECK_THROWS_AS(applied("deform-branch", scene, {{"at", Vec3(2, 0, 35)}}), DiagnosedUsage);
}

SCENARIO("part-branches reports what moved and the gaps", "[workbench][posing]") {
    const Scene scene = scene_of(gap_phantom(8).surface);
    const Outcome outcome = applied("part-branches", scene, {{"gap", 1.0}});
    const auto& gap = outcome.report->at("gaps").at(0);
    CHECK(gap.at("before_mm").get<double>() < 1.0);
    CHECK(gap.at("after_mm").get<double>() >= 1.0);
    CHECK(outcome.report->at("shifts").at(0).at("largest_mm").get<double>() > 0.0);
    REQUIRE(outcome.warnings.size() == 1);
    CHECK(outcome.warnings[0].code == "branches-parted");
    const Outcome apart = applied("part-branches", scene, {{"gap", 0.3}});
    CHECK(apart.warnings.at(0).code == "branches-apart");
    CHECK(apart.scene.surface->points() == scene.surface->points());
}
