#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "tests/support/crowded_contacts.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/touching_vessels.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/shared/handle_warnings.h"
#include "workbench/operations/table.h"
#include "workbench/session/guarded_run.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

namespace {

Outcome separated(const Surface& surface, const Arguments& arguments) {
    Scene scene;
    scene.surface = surface;
    Progress progress;
    const Operation& operation = find_operation("separate");
    return run_here(operation, scene, checked_arguments(operation, arguments), progress);
}

/// The vessels of touching_vessels(), joined at their ends as well: a ring through the contact.
Surface ring() {
    return solid_of(
        [](const Vec3& p) {
            return std::min({capsule(p, {-12, 0, -2.5}, {12, 0, -2.5}, kTouchingRadius),
                             capsule(p, {0, -12, 2.5}, {0, 12, 2.5}, kTouchingRadius),
                             capsule(p, {12, 0, -2.5}, {12, 12, 0}, kTouchingRadius),
                             capsule(p, {12, 12, 0}, {0, 12, 2.5}, kTouchingRadius),
                             capsule(p, {0, 0, -2}, {0, 0, 2}, kTouchingBridge)});
        },
        Eigen::AlignedBox3d(Vec3(-15, -15, -6), Vec3(15, 15, 6)), 0.4);
}

}  // namespace

SCENARIO("separate parts two vessels at a place of their contact", "[workbench][separate]") {
    const Surface before = touching_vessels(0.35);
    const Outcome outcome = separated(before, {{"at", Vec3(0.8, 0, 0)}, {"gap", 0.5}});
    CHECK(outcome.report->at("components_after") == 2);
    CHECK(outcome.report->at("gap_mm").get<double>() >= 0.5);
    CHECK(outcome.report->at("waist").get<double>() == Approx(0.4).epsilon(0.2));
    THEN("its decisions, given, make the same surface") {
        CHECK(outcome.resolved.has("side_a"));
        const Outcome again = separated(before, outcome.resolved);
        CHECK(again.scene.surface->points() == outcome.scene.surface->points());
    }
}

SCENARIO("separate finds a contact by the handle that it makes", "[workbench][separate]") {
    const Surface before = ring();
    REQUIRE(connectivity(*before.topology).genus == 1);
    const Outcome outcome = separated(before, {});
    CHECK(outcome.resolved.point("at").norm() < 1.5);
    CHECK(outcome.resolved.real("gap") == Approx(1.5 * mean_edge_length(before)));
    CHECK(outcome.report->at("genus_before") == 1);
    CHECK(outcome.report->at("genus_after") == 0);
    CHECK(outcome.report->at("components_after") == 1);
    THEN("the warning about the handle offers it") {
        const auto warnings = handle_warnings(before, Progress());
        REQUIRE(warnings.size() == 1);
        REQUIRE(warnings[0].remedies.size() == 1);
        CHECK(warnings[0].remedies[0].operation == "separate");
    }
    THEN("what it would decide is known before it runs") {
        Scene scene;
        scene.surface = before;
        const Operation& operation = find_operation("separate");
        CHECK(operation.decided(scene, checked_arguments(operation, {}), Progress()).values() ==
              outcome.resolved.values());
    }
}

SCENARIO("The bundled case's image alone becomes two outlets of one vessel",
         "[workbench][separate]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    const auto run = [&](const std::vector<std::string>& words) {
        const ProgramRun made = run_program(program_path(), words);
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
        return made.out;
    };
    run({"phantom", "aneurysm", "--out", folder});
    run({"new", project, folder + "/image.nii.gz"});
    run({"apply", project, "extract-surface", "threshold=400"});
    const auto parted = nlohmann::json::parse(run({"apply", project, "separate", "--json"}));
    CHECK(parted["report"]["genus_before"] == 1);
    CHECK(parted["report"]["genus_after"] == 0);
    run({"apply", project, "remove-branch", "tip=0,5.6,8.2"});
    run({"apply", project, "remove-branch", "tip=2.4,-6,41.2"});
    // The dome of a wide aneurysm may be a vessel's end as well: it is named.
    const auto opened = nlohmann::json::parse(
        run({"apply", project, "clip-opening", "closed=-5,-2.5,17.2", "--json"}));
    std::vector<std::string> names;
    for (const auto& opening : opened["resolved"]["names"]) names.push_back(opening["name"]);
    CHECK(names == std::vector<std::string>{"inlet", "outlet_1", "outlet_2"});
}

SCENARIO("separate takes nothing but the bridge between two vessels", "[workbench][separate]") {
    const Operation& operation = find_operation("separate");
    const auto check = [&](Crowd crowd, std::uint64_t number) {
        CAPTURE(static_cast<int>(crowd), number);
        const CrowdedContact contact = crowded_contact(crowd, number);
        Scene scene;
        scene.surface = contact.surface;
        try {
            const Outcome outcome = separated(contact.surface, {{"at", contact.place}});
            const auto excess = overreach_of(operation, scene, outcome, Progress());
            if (excess) CHECK(excess->place.has_value());
            if (excess) return std::string(excess->code);
            CHECK(farthest_kept(contact, *outcome.scene.surface) < 0.3 * contact.thinnest);
        } catch (const DiagnosedFailure& failure) {
            return failure.diagnostics().front().code;
        }
        return std::string();
    };
    THEN("a sac that touches a vessel is not cut away") {
        CHECK(check(Crowd::Sac, 1) == "contact-too-wide");
        CHECK(check(Crowd::Sac, 2) == "contact-not-alone");
        for (const std::uint64_t number : {3, 4}) CHECK_FALSE(check(Crowd::Sac, number).empty());
    }
    THEN("near a furcation, and beside a third vessel, two vessels are parted or it is refused") {
        CHECK(check(Crowd::Furcation, 3).empty());
        CHECK(check(Crowd::Furcation, 1) == "contact-not-parted");
        CHECK(check(Crowd::Third, 3).empty());
        CHECK(check(Crowd::Third, 1) == "contact-without-arms");
    }
}

SCENARIO("The session refuses a separation that would take a sac", "[workbench][separate]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    const CrowdedContact contact = crowded_contact(Crowd::Sac, 3);
    write_surface(contact.surface, folder + "/sac.ply");
    const auto run = [&](const std::vector<std::string>& words) {
        return run_program(program_path(), words);
    };
    REQUIRE(run({"new", project, folder + "/sac.ply", "--units", "mm"}).exit_code == 0);
    const ProgramRun refused =
        run({"apply", project, "separate", "at=" + to_text(Value(contact.place))});
    CHECK(refused.exit_code == 1);
    CHECK_THAT(refused.err, Contains("wider than the thinner vessel") && Contains("sac"));
    const auto log = nlohmann::json::parse(run({"log", project, "--json"}).out);
    CHECK(log.dump().find("separate") == std::string::npos);
}

SCENARIO("separate without a contact says so", "[workbench][separate]") {
    const Surface tube = fine_tube(4.0, 30.0, 24);
    CHECK_THROWS_WITH(separated(tube, {}), Contains("no handle"));
    CHECK_THROWS_WITH(separated(tube, {{"at", Vec3(4, 0, 15)}}), Contains("arms"));
    CHECK_THROWS_WITH(separated(tube, {{"at", Vec3(4, 0, 15)}, {"side_a", Vec3(0, 0, 1)}}),
                      Contains("both side_a and side_b"));
}
