#include "geometry/vessel/openings/frayed_trunks.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/straight_branch.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kTrunk = 4.0;

/// A trunk along z that divides at z = -30 into two vessels, and whose upper end, at z = 14, gives
/// off four threads of this radius, two of them joined by a bridge.
Surface frayed_vessel(double thread) {
    const Positions ends = {{2.5, 0.3, 21}, {-0.4, 2.2, 20}, {-2.3, -0.2, 22}, {0.2, -2.4, 19.5}};
    const auto field = [&](const Vec3& p) {
        double least = std::min({capsule(p, Vec3(0, 0, -30), Vec3(0, 0, 10), kTrunk),
                                 capsule(p, Vec3(0, 0, -30), Vec3(14, 0, -52), 2.6),
                                 capsule(p, Vec3(0, 0, -30), Vec3(-13, 3, -54), 2.5)});
        for (const Vec3& end : ends)
            least = std::min(least, capsule(p, Vec3(0, 0, 11), end, thread));
        const auto between = [&](std::size_t i) {
            return Vec3(0.3 * Vec3(0, 0, 11) + 0.7 * ends[i]);
        };
        return std::min(least, capsule(p, between(0), between(1), thread));
    };
    return repair(iso_surface(field, {Vec3(-20, -9, -60), Vec3(20, 9, 26)}, 0.3)).surface;
}

/// A trunk of radius 4 over `length` along x to the origin, and threads from there.
CenterlineGraph trunk_with(double length, const std::vector<std::pair<Vec3, double>>& threads) {
    CenterlineGraph graph;
    graph.nodes = {{Vec3(-length, 0, 0), kTrunk, {0}}, {Vec3::Zero(), kTrunk, {0}}};
    graph.branches = {straight_branch(0, 1, graph.nodes[0].position, Vec3::Zero(), kTrunk)};
    for (const auto& [tip, radius] : threads) {
        const std::size_t branch = graph.branches.size(), node = graph.nodes.size();
        graph.nodes[1].branches.push_back(branch);
        graph.nodes.push_back({tip, radius, {branch}});
        graph.branches.push_back(straight_branch(1, node, Vec3::Zero(), tip, radius));
    }
    return graph;
}

std::size_t frays_of(const CenterlineGraph& graph) {
    return without_frays(icosphere(1.0, 1), graph).trunks.size();
}

}  // namespace

SCENARIO("A trunk that frays into threads is opened where it is whole", "[geometry][openings]") {
    const Surface surface = frayed_vessel(0.5);
    const auto graph = centerlines_of(surface);
    const LinesWithoutFrays lines = without_frays(surface, *graph);
    REQUIRE(lines.trunks.size() == 1);
    const FrayedTrunk& trunk = lines.trunks.front();
    CHECK(trunk.ends.size() == 4);
    for (const ThinEnd& thread : trunk.ends) {
        CHECK(thread.place.z() > 18.0);
        CHECK(thread.diameter < 1.2);
    }
    THEN("the lines end with the whole trunk") {
        const CenterlineNode& end = lines.graph.nodes[trunk.tip];
        CHECK(end.is_tip());
        CHECK(end.position.z() > 5.0);
        CHECK(tip_radius(lines.graph, trunk.tip) == Approx(kTrunk).epsilon(0.05));
        const auto tips = std::ranges::count_if(lines.graph.nodes, &CenterlineNode::is_tip);
        CHECK(tips == 3);
    }
    THEN("it is cut across, and the report has its threads") {
        const OpeningPlan plan = plan_openings(surface, *graph);
        CHECK(plan.openings.size() == 3);
        CHECK(why_no_flow(plan).empty());
        const auto record = std::ranges::max_element(plan.ends, {}, &EndRecord::diameter);
        CHECK(record->fate == EndFate::Opened);
        CHECK_FALSE(record->plain);
        CHECK_THAT(record->why, Catch::Matchers::Contains("splits there into 4 strands"));
        CHECK(std::ranges::count(plan.ends, EndFate::Removed, &EndRecord::fate) == 4);
        const Surface made = clip_openings(surface, plan, {.promote = true}).surface;
        const PatchShape inlet = patch_shape(made, 1);
        CHECK(made.patches[1].kind == PatchKind::Inlet);
        CHECK(inlet.diameter() == Approx(2.0 * kTrunk).epsilon(0.03));
        CHECK(inlet.plane.normal.z() > 0.99);
        CHECK(inlet.plane.point.z() > 5.0);
        CHECK(lost_vessels(lines.graph, made).empty());
    }
}

SCENARIO("Vessels that leave a trunk are no fray", "[geometry][openings]") {
    const std::vector<std::pair<Vec3, double>> threads = {
        {{12, 0, 0}, 0.5}, {{11, 5, 0}, 0.4}, {{11, 0, 6}, 0.6}};
    REQUIRE(frays_of(trunk_with(30.0, threads)) == 1);
    THEN("nor are two threads") {
        CHECK(frays_of(trunk_with(30.0, {threads[0], threads[1]})) == 0);
    }
    THEN("nor is one that is wider than a quarter of the trunk among them") {
        auto wide = threads;
        wide[1].second = 1.1;
        CHECK(frays_of(trunk_with(30.0, wide)) == 0);
    }
    THEN("nor are many that share a tenth of its section") {
        std::vector<std::pair<Vec3, double>> many;
        for (int i = 0; i < 12; ++i) many.push_back({Vec3(10, i - 6.0, 2.0), 0.4});
        CHECK(frays_of(trunk_with(30.0, many)) == 0);
        many.resize(9);
        CHECK(frays_of(trunk_with(30.0, many)) == 1);
    }
    THEN("nor are those that reach far") {
        auto far = threads;
        far[0].first = Vec3(23, 0, 0);
        CHECK(frays_of(trunk_with(30.0, far)) == 0);
    }
    THEN("nor do they leave a sac, which is no longer than it is wide") {
        CHECK(frays_of(trunk_with(7.0, threads)) == 0);
        CenterlineGraph necked = trunk_with(30.0, threads);
        for (std::size_t i = 0; i < 80; ++i) necked.branches[0].radii[i] = 2.0;
        CHECK(frays_of(necked) == 0);
    }
}
