#include <algorithm>
#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/surface.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/phantom.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/end_choice.h"
#include "geometry/vessel/ends/flow_tree.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/openings.h"
#include "tests/support/forked_vessel.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kTrunk = kForkTrunk;

const SurfaceEnd& lowest(const std::vector<SurfaceEnd>& ends) {
    return *std::ranges::min_element(ends, {}, [](const SurfaceEnd& e) { return e.centre.z(); });
}

}  // namespace

SCENARIO("A tree that obeys Murray's law shows its root", "[geometry][ends]") {
    const double daughter = kTrunk / std::cbrt(2.0);
    const Surface surface = forked_vessel(daughter, daughter);
    const auto graph = centerlines_of(surface);
    const std::vector<SurfaceEnd> ends = find_surface_ends(surface, *graph);
    REQUIRE(ends.size() == 3);
    const FlowTree tree(*graph, course_diameters(*graph));
    const RootFigures root = tree.figures(*lowest(ends).tip);
    CHECK(root.murray < 0.05);
    CHECK(root.turn < 0.3);
    for (const SurfaceEnd& end : ends) {
        if (end.tip == lowest(ends).tip) continue;
        const RootFigures wrong = tree.figures(*end.tip);
        CHECK(wrong.murray > 3.0 * root.murray);
        CHECK(wrong.turn > 2.0 * root.turn);
    }
}

SCENARIO("The inlet's odds are of all ends, and know no unit", "[geometry][ends]") {
    const auto chosen = [](const Surface& surface) {
        const auto graph = centerlines_of(surface);
        return choose_ends({.surface = surface, .graph = *graph},
                           find_surface_ends(surface, *graph), {});
    };
    const Surface surface = forked_vessel(1.4, 1.1);
    const EndChoice choice = chosen(surface);
    REQUIRE(choice.inlet);
    double sum = 0.0, most = 0.0;
    for (const EndVerdict& verdict : choice.ends) {
        REQUIRE(verdict.inlet);
        sum += verdict.inlet->odds;
        most = std::max(most, verdict.inlet->odds);
    }
    CHECK(sum == Approx(1.0));
    CHECK(choice.ends[*choice.inlet].inlet->odds == most);
    const auto graph = centerlines_of(surface);
    CHECK(find_surface_ends(surface, *graph)[*choice.inlet].centre.z() < 0.0);
    CHECK_FALSE(has_rival(choice.ends, *choice.inlet, std::vector(choice.ends.size(), true)));
}

SCENARIO("An outlet that is wider than the inlet is asked about, and the answer is one argument",
         "[geometry][ends]") {
    GIVEN("a tube whose ends are alike") {
        const Surface tube = open_tube(kTrunk, 30.0, 40, 60);
        const auto graph = centerlines_of(tube);
        const OpeningPlan plan = plan_openings(tube, *graph);
        CHECK_FALSE(plan.inlet_doubtful);
        const OpeningPlan named = plan_openings(tube, *graph, {.inlets = {Vec3(0, 0, 30)}});
        REQUIRE(named.inlets.size() == 1);
        CHECK(named.openings[named.inlets[0]].place.plane.point.z() == Approx(30.0).margin(0.5));
    }
    GIVEN("a choice whose likeliest inlet is not the widest end") {
        const EndVerdict narrow{.odds = {0.99, 0.0, 0.01},
                                .share = 1.0,
                                .inlet = InletCandidate{.end = 0, .width = 2.0, .odds = 0.6}};
        EndVerdict wide = narrow;
        wide.inlet = InletCandidate{.end = 1, .width = 3.0, .odds = 0.4};
        OpeningPlan plan{
            .openings = {{}, {}},
            .ends = {{.fate = EndFate::Kept, .verdict = narrow, .number = 1, .opening = 0},
                     {.fate = EndFate::Kept, .verdict = wide, .number = 2, .opening = 1}},
            .inlets = {0}};
        CHECK(why_no_flow(plan).empty());
        plan.inlet_doubtful = true;
        CHECK_THAT(why_no_flow(plan),
                   Contains("the blood enters at end 1") && Contains("rather than at end 2"));
        CHECK(why_no_flow(plan, true).empty());
    }
}

SCENARIO("What is closed beside two open rims is opened only where somebody asks",
         "[geometry][ends]") {
    const auto vessel = [](const Vec3& from, const Vec3& to, double radius, bool flat) {
        return VesselShape{.points = {from, to}, .radii = {radius, radius}, .flat_ends = flat};
    };
    const std::vector<PhantomPart> parts = {
        {.name = "vessel", .shape = vessel(Vec3(0, 0, -17), Vec3(0, 0, 17), 1.8, true)},
        {.name = "branch",
         .shape = vessel(Vec3::Zero(), Vec3(14, 0, 3), 1.3, false),
         .blend = 0.2}};
    const PhantomField field(parts);
    const Surface closed = exact_surface(field, field.bounds(), 0.35);
    std::vector<bool> keep;
    for (const Triangle& t : closed.triangles())
        keep.push_back(std::abs(closed.points()[t[0]].z()) < 15.0);
    const Surface open = select_triangles(closed, keep);
    const auto graph = centerlines_of(open);
    const OpeningPlan plan = plan_openings(open, *graph);
    const Vec3 tip(15, 0, 3.2);
    const auto at_tip = [&](const OpeningPlan& of) {
        return *std::ranges::min_element(
            of.ends, {}, [&](const EndRecord& end) { return (end.place - tip).norm(); });
    };
    CHECK(plan.openings.size() == 2);
    CHECK(at_tip(plan).fate == EndFate::Closed);
    CHECK(at_tip(plan).verdict->profile.cuts_beside == 2);
    CHECK(plan_openings(open, *graph, {.open = {tip}}).openings.size() == 3);
}

namespace {

/// A line along a path, of one radius [mm].
CenterlineBranch line(std::size_t from, std::size_t to, const Vec3& start, const Vec3& end,
                      double radius) {
    CenterlineBranch branch{.start_node = from, .end_node = to, .points = {}, .radii = {}};
    for (int i = 0; i <= 40; ++i) {
        branch.points.push_back(start + (end - start) * i / 40.0);
        branch.radii.push_back(radius);
    }
    return branch;
}

/// A trunk along z that gives off a branch, and splits at z = 24 into two short tips.
CenterlineGraph split_trunk() {
    const Vec3 root(0, 0, -24), side(20, 0, 0), middle = Vec3::Zero(), split(0, 0, 24);
    const Vec3 left(-2, 0, 27), right(2, 0, 27);
    return {.nodes = {{root, 3.0, {0}},
                      {middle, 3.0, {0, 1, 2}},
                      {side, 2.0, {1}},
                      {split, 3.0, {2, 3, 4}},
                      {left, 1.0, {3}},
                      {right, 1.0, {4}}},
            .branches = {line(0, 1, root, middle, 3.0), line(1, 2, middle, side, 2.0),
                         line(1, 3, middle, split, 3.0), line(3, 4, split, left, 1.0),
                         line(3, 5, split, right, 1.0)}};
}

}  // namespace

SCENARIO("The vessels that lead to an end are known", "[geometry][ends]") {
    const CenterlineGraph graph = split_trunk();
    const auto from_root = vessels_from(graph, 0);
    REQUIRE(from_root[4].size() == 1);
    CHECK(from_root[4][0].branch == 2);
    CHECK(from_root[4][0].diameter == Approx(6.0));
    CHECK(from_root[5].size() == 1);
    CHECK(from_root[2].empty());
    CHECK(vessels_from(graph, 4)[5].empty());
    CHECK(vessels_from(graph, 4)[2].size() == 1);
}

SCENARIO("A rim to which no line leads is no likelier inlet for it", "[geometry][ends]") {
    const Surface whole = forked_vessel(1.4, 1.1);
    const Vec3 hole(kTrunk, 0, -9);
    std::vector<bool> keep;
    for (const Triangle& t : whole.triangles())
        keep.push_back((whole.points()[t[0]] - hole).norm() > 1.2);
    const Surface surface = select_triangles(whole, keep);
    const auto graph = centerlines_of(whole);
    const std::vector<SurfaceEnd> ends = find_surface_ends(surface, *graph);
    const EndChoice choice = choose_ends({.surface = surface, .graph = *graph}, ends, {});
    double least = 1e9, without_line = -1.0;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        if (!choice.ends[e].inlet) continue;
        const double murray = choice.ends[e].inlet->features[0];
        if (ends[e].tip)
            least = std::min(least, murray);
        else
            without_line = murray;
    }
    REQUIRE(without_line >= 0.0);
    CHECK(without_line > least);
}
