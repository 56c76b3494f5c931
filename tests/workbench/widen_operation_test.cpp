#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/self_intersections.h"
#include "tests/support/crowded_contacts.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"
#include "workbench/session/guarded_run.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

namespace {

Outcome widened(const Scene& scene, const Arguments& arguments) {
    Progress progress;
    const Operation& operation = find_operation("widen");
    return operation.run(scene, checked_arguments(operation, arguments), progress);
}

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

/// A tube of 2 mm radius that is 0.1 mm wide halfway.
Surface tube_with_thread() {
    return mapped(closed_tube(2.0, 30.0, 24, 90), [](const Vec3& p) {
        const double width = 0.025 + 0.975 * std::min(1.0, std::abs(p.z() - 15.0) / 3.0);
        return Vec3(width * p.x(), width * p.y(), p.z());
    });
}

}  // namespace

SCENARIO("widen takes half the image's smallest voxel edge, and names the place",
         "[workbench][widen]") {
    Scene scene = scene_of(tube_with_thread());
    CHECK_THROWS_WITH(widened(scene, {}), Contains("give width"));
    scene.sampling = Sampling{.spacing = Vec3(1.0, 1.2, 3.0), .confidence = 1.0};
    const Outcome outcome = widened(scene, {});
    CHECK(outcome.resolved.real("width") == 0.5);
    REQUIRE(outcome.warnings.size() == 1);
    const Diagnostic& warning = outcome.warnings[0];
    CHECK(warning.code == "lumen-widened");
    CHECK(warning.place->z() == Approx(15.0).margin(0.5));
    CHECK(warning.figures.at("limit_mm") == 0.5);
    CHECK(warning.figures.at("places") == 1.0);
    CHECK(warning.figures.at("width_mm") == Approx(0.1).margin(0.05));
    const auto& places = outcome.report->at("places");
    REQUIRE(places.size() == 1);
    CHECK(places[0].at("place_mm")[2].get<double>() == Approx(15.0).margin(0.5));
    CHECK(places[0].at("width_mm").get<double>() == Approx(0.1).margin(0.05));
    CHECK(outcome.report->at("still_narrow").empty());
    CHECK(widened(scene, outcome.resolved).scene.surface->points() ==
          outcome.scene.surface->points());
    const Outcome again = widened(outcome.scene, {{"width", 0.4}});
    CHECK(again.warnings.empty());
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
}

SCENARIO("widen does not push a thread through a wall beside it", "[workbench][widen]") {
    // The neighbour's wall runs 0.1 mm beside the thread.
    const Surface neighbour = mapped(closed_tube(1.0, 30.0, 24, 90), [](const Vec3& p) {
        const double bend = 0.9 * std::min(3.0, std::abs(p.z() - 15.0));
        return Vec3(p.x() + 1.15 + bend, p.y(), p.z());
    });
    const Scene scene = scene_of(merged(tube_with_thread(), neighbour));
    REQUIRE(self_intersections(*scene.surface).empty());
    const Outcome outcome = widened(scene, {{"width", 0.8}});
    CHECK(self_intersections(*outcome.scene.surface).empty());
    CHECK(outcome.warnings.at(0).code == "widening-crosses-walls");
    CHECK(outcome.warnings.at(2).code == "still-narrow");
    CHECK(outcome.warnings.at(2).figures.at("places") == 1.0);
}

SCENARIO("widen is refused where it would fold the walls beside a thread", "[workbench][widen]") {
    const Operation& operation = find_operation("widen");
    const auto excess = [&](const Scene& scene, const Outcome& outcome) {
        return overreach_of(operation, scene, outcome, Progress());
    };
    GIVEN("a thread in a vessel") {
        const Scene scene = scene_of(tube_with_thread());
        for (const double width : {0.4, 0.8, 1.2})
            CHECK_FALSE(excess(scene, widened(scene, {{"width", width}})));
    }
    GIVEN("a thread between two healthy vessels") {
        for (const std::uint64_t number : {1, 5}) {
            const Scene scene = scene_of(crowded_contact(Crowd::Thread, number, 0.25).surface);
            const auto found = excess(scene, widened(scene, {{"width", 1.0}}));
            REQUIRE(found);
            CHECK(found->code == "edit-folds-wall");
            CHECK(found->place.has_value());
        }
    }
}
