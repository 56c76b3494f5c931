#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "tests/support/crowded_contacts.h"
#include "tests/support/shapes.h"
#include "tests/support/touching_vessels.h"
#include "workbench/operations/table.h"
#include "workbench/session/guarded_run.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

namespace {

Outcome done(const std::string& name, const Surface& surface, const Arguments& arguments) {
    Scene scene;
    scene.surface = surface;
    Progress progress;
    const Operation& operation = find_operation(name);
    return run_here(operation, scene, checked_arguments(operation, arguments), progress);
}

}  // namespace

SCENARIO("stamp separates two vessels from a place on their contact alone", "[workbench][stamp]") {
    const Surface before = touching_vessels(0.35);
    const Outcome outcome = done("stamp", before, {{"at", Vec3(0.8, 0, 0)}});
    CHECK(outcome.report->at("components_after") == 2);
    CHECK(outcome.report->at("genus_after") == 0);
    CHECK(outcome.report->at("removed_mm3").get<double>() > 0.1);
    CHECK(outcome.resolved.point("direction").z() > 0.99);
    CHECK(outcome.resolved.real("thickness") == Approx(0.4).epsilon(0.1));
    const Outcome again = done("stamp", before, outcome.resolved);
    CHECK(again.scene.surface->points() == outcome.scene.surface->points());
}

SCENARIO("stamp without a contact asks for a direction", "[workbench][stamp]") {
    const Surface tube = fine_tube(4.0, 30.0, 24);
    CHECK_THROWS_WITH(done("stamp", tube, {{"at", Vec3(4, 0, 15)}}), Contains("direction"));
    CHECK_THROWS_WITH(done("stamp", tube, {}), Contains("at=x,y,z"));
    CHECK_THROWS_WITH(done("stamp", tube, {{"shape", std::string("polygon")}}), Contains("path"));
    CHECK_THROWS_WITH(
        done("stamp", tube,
             {{"shape", std::string("polygon")}, {"path", std::vector<double>{1, 2, 3, 4}}}),
        Contains("three numbers"));
    const Outcome outcome =
        done("stamp", tube, {{"at", Vec3(4, 0, 15)}, {"direction", Vec3(1, 0, 0)}});
    CHECK(outcome.report->at("components_after") == 1);
}

SCENARIO("stamp sweeps a polygon along a path", "[workbench][stamp]") {
    const Surface tube = fine_tube(4.0, 30.0, 24);
    const Outcome outcome = done("stamp", tube,
                                 {{"shape", std::string("polygon")},
                                  {"mode", std::string("add")},
                                  {"path", std::vector<double>{4, 0, 10, 4.5, 0, 15, 4, 0, 20}},
                                  {"radius", 1.0}});
    CHECK(outcome.report->at("added_mm3").get<double>() > 5.0);
}

SCENARIO("remesh and subdivide work around a place", "[workbench][local]") {
    const Surface tube = fine_tube(4.0, 30.0, 24);
    const Outcome remeshed = done("remesh", tube, {{"at", Vec3(4, 0, 15)}, {"within", 2.0}});
    CHECK(remeshed.resolved.real("edge") == 0.5);
    CHECK(remeshed.report->at("edge_before_mm").get<double>() == Approx(1.05).epsilon(0.1));
    CHECK(remeshed.scene.surface->triangle_count() > tube.triangle_count());
    const Outcome split = done("subdivide", tube, {{"at", Vec3(4, 0, 15)}});
    CHECK(split.resolved.real("within") == Approx(4.0).epsilon(0.05));
    CHECK(split.scene.surface->triangle_count() < 4 * tube.triangle_count());
    CHECK(split.scene.surface->triangle_count() > tube.triangle_count());
}

SCENARIO("A brush smaller than the triangles offers to refine them", "[workbench][local]") {
    const Surface tube = fine_tube(4.0, 30.0, 24);
    const Arguments dab = {{"at", Vec3(4, 0, 15)}, {"radius", 1.5}, {"strength", 1.0}};
    const Outcome coarse = done("brush-inflate", tube, dab);
    REQUIRE(!coarse.warnings.empty());
    const Diagnostic& warning = coarse.warnings.back();
    CHECK(warning.code == "brush-coarse");
    REQUIRE(warning.remedies.size() == 1);
    CHECK(warning.remedies[0].operation == "remesh");
    const Surface fine =
        *done("remesh", tube, {{"at", Vec3(4, 0, 15)}, {"within", 1.5}}).scene.surface;
    for (const Diagnostic& other : done("brush-inflate", fine, dab).warnings)
        CHECK(other.code != "brush-coarse");
}

SCENARIO("A slab at a contact goes between two vessels, not through one", "[workbench][stamp]") {
    const Operation& operation = find_operation("stamp");
    const auto refusal = [&](Crowd crowd, std::uint64_t number) {
        const CrowdedContact contact = crowded_contact(crowd, number);
        Scene scene;
        scene.surface = contact.surface;
        Progress progress;
        const Outcome outcome = run_here(
            operation, scene, checked_arguments(operation, {{"at", contact.place}}), progress);
        const auto excess = overreach_of(operation, scene, outcome, progress);
        if (!excess) CHECK_FALSE(cuts_vessel(contact, *outcome.scene.surface));
        if (excess) CHECK(excess->place.has_value());
        return excess ? excess->code : "";
    };
    THEN("a sac that touches a vessel is freed, and keeps its neck") {
        CHECK(refusal(Crowd::Sac, 6) == "");
        CHECK(refusal(Crowd::Sac, 1) == "contact-cuts-vessel");
    }
    THEN("a vessel that is narrow between others is not cut") {
        CHECK(refusal(Crowd::Third, 5) == "contact-cuts-vessel");
        CHECK(refusal(Crowd::Furcation, 3) == "contact-elsewhere");
    }
}
