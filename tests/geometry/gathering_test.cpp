// Vessels in which blood gathers: veins.

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/patch_shape.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/openings.h"
#include "tests/support/forked_vessel.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

bool is_trunk(const PlannedOpening& opening) {
    return opening.place.plane.point.z() < 0.0;
}

/// The surface with its openings made and named as the plan says.
Surface opened(const Surface& surface, const OpeningPlan& plan) {
    InletChoice choice{.promote = true, .gathers = plan.gathers};
    for (const std::size_t inlet : plan.inlets)
        choice.points.push_back(plan.openings[inlet].place.plane.point);
    return clip_openings(surface, plan, choice).surface;
}

std::vector<Patch> openings_of(const Surface& surface) {
    return {surface.patches.begin() + 1, surface.patches.end()};
}

const Patch kInlet{"inlet", PatchKind::Inlet}, kInlet1{"inlet_1", PatchKind::Inlet},
    kInlet2{"inlet_2", PatchKind::Inlet}, kOutlet{"outlet", PatchKind::Outlet},
    kOutlet1{"outlet_1", PatchKind::Outlet}, kOutlet2{"outlet_2", PatchKind::Outlet};

}  // namespace

SCENARIO("Blood that gathers enters at all ends but the trunk's", "[geometry][openings]") {
    const Surface surface = forked_vessel(1.5, 1.2);
    const auto graph = centerlines_of(surface);
    const OpeningPlan plan = plan_openings(surface, *graph, {.gathers = true});
    REQUIRE(plan.openings.size() == 3);
    CHECK(plan.inlets.size() == 2);
    for (const std::size_t inlet : plan.inlets) CHECK_FALSE(is_trunk(plan.openings[inlet]));
    CHECK_FALSE(plan.inlet_doubtful);
    CHECK(why_no_flow(plan).empty());
    const Surface vein = opened(surface, plan);
    CHECK(openings_of(vein) == std::vector{kInlet1, kInlet2, kOutlet});
    CHECK(patch_shape(vein, 3).plane.point.z() < 0.0);
    THEN("the same vessel as an artery has the same ends, and they are the other way round") {
        const OpeningPlan artery = plan_openings(surface, *graph);
        REQUIRE(artery.inlets.size() == 1);
        CHECK(is_trunk(artery.openings[artery.inlets[0]]));
        CHECK(openings_of(opened(surface, artery)) == std::vector{kInlet, kOutlet1, kOutlet2});
    }
    THEN("inlets that are named are the only ones") {
        const OpeningPlan named =
            plan_openings(surface, *graph, {.gathers = true, .inlets = {Vec3(0, 0, -18)}});
        REQUIRE(named.inlets.size() == 1);
        CHECK(is_trunk(named.openings[named.inlets[0]]));
    }
    THEN("inlets that the file names stay") {
        const Surface artery = opened(surface, plan_openings(surface, *graph));
        const OpeningPlan again = plan_openings(artery, *centerlines_of(artery), {.gathers = true});
        CHECK(openings_of(opened(artery, again)) == std::vector{kInlet, kOutlet1, kOutlet2});
    }
    THEN("an outlet that the file names is the outlet, though another end is wider") {
        std::vector<Patch> patches = vein.patches;
        patches[1] = {"femoral", PatchKind::Outlet};
        patches[2] = {"cut_1", PatchKind::Cut};
        patches[3] = {"cut_2", PatchKind::Cut};
        const Surface named = vein.with_patches(*vein.patch_labels, patches);
        const OpeningPlan of_file = plan_openings(named, *centerlines_of(named), {.gathers = true});
        CHECK(openings_of(opened(named, of_file)) ==
              std::vector{kInlet1, kInlet2, Patch{"femoral", PatchKind::Outlet}});
    }
}

SCENARIO("Of a tube with equal ends one is the outlet of a vein", "[geometry][openings]") {
    const Surface surface = forked_vessel(1.5, 1.2, 2.0);
    const auto graph = centerlines_of(surface);
    const Positions closed = {Vec3(20, 0, 28)};
    const OpeningPlan plan = plan_openings(surface, *graph, {.gathers = true, .closed = closed});
    REQUIRE(plan.openings.size() == 2);
    CHECK(plan.inlets.size() == 1);
    CHECK(openings_of(opened(surface, plan)) == std::vector{kInlet, kOutlet});
}

SCENARIO("Where a vein's outlet is in doubt, all its inlets are the answer",
         "[geometry][openings]") {
    const Surface surface = forked_vessel(kForkTrunk, kForkTrunk);
    const auto graph = centerlines_of(surface);
    OpeningPlanOptions options{.gathers = true};
    OpeningPlan plan = plan_openings(surface, *graph, options);
    REQUIRE(plan.inlets.size() == 2);
    plan.inlet_doubtful = true;
    CHECK_THAT(why_no_flow(plan), Contains("the blood leaves at end") && Contains("rather than"));
    try {
        check_flow(plan, surface, *graph, options);
        FAIL("there is a doubt");
    } catch (const DiagnosedFailure& failure) {
        const auto& arguments = failure.diagnostics().front().remedies.front().arguments;
        REQUIRE(arguments.contains("inlet_ends"));
        CHECK(arguments.at("inlet_ends").size() == 3);  // "2,3"
    }
}
