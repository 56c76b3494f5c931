#include "geometry/vessel/openings/fading_ends.h"

#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "tests/support/straight_branch.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// One vessel from the origin, whose tip is node 1.
CenterlineGraph vessel(const Vec3& to, const std::function<double(double)>& radius) {
    CenterlineGraph graph;
    graph.branches = {straight_branch(0, 1, Vec3::Zero(), to, radius)};
    graph.nodes = {{Vec3::Zero(), radius(0.0), {0}}, {to, radius(1.0), {0}}};
    return graph;
}

/// Two vessels, each from a far node to a tip: 0 -> 1 and 2 -> 3.
CenterlineGraph two_vessels(const Vec3& a, const Vec3& tip_a, const Vec3& b, const Vec3& tip_b) {
    const auto radius = [](double) { return 1.0; };
    CenterlineGraph graph;
    graph.branches = {straight_branch(0, 1, a, tip_a, radius),
                      straight_branch(2, 3, b, tip_b, radius)};
    graph.nodes = {{a, 1.0, {0}}, {tip_a, 1.0, {0}}, {b, 1.0, {1}}, {tip_b, 1.0, {1}}};
    return graph;
}

SurfaceEnd closed_end(const CenterlineGraph& graph, std::size_t tip) {
    return {.centre = graph.nodes[tip].position,
            .diameter = 2.0,
            .patch = std::nullopt,
            .rim = {},
            .tip = tip,
            .vertex = 0};
}

}  // namespace

SCENARIO("A vessel is measured in the voxels across it", "[geometry][openings]") {
    const VoxelEdges voxels = Vec3(0.5, 0.5, 2.0).asDiagonal();
    const auto radius = [](double) { return 0.6; };
    WHEN("it runs along the thick slices' axis") {
        const VoxelWidth width = width_at_tip(vessel({0, 0, 30}, radius), 1, voxels);
        THEN("only the fine edges lie across it: the end is shown") {
            CHECK(width.diameter == Approx(1.2));
            CHECK(width.voxels == Approx(0.5));
            CHECK(width.lower_quartile == Approx(2.4));
            CHECK_FALSE(width.is_fading());
        }
    }
    WHEN("it runs within the slices") {
        const VoxelWidth width = width_at_tip(vessel({30, 0, 0}, radius), 1, voxels);
        THEN("the slices' distance lies across it: the end may be none") {
            CHECK(width.voxels == Approx(2.0));
            CHECK(width.lower_quartile == Approx(0.6));
            const VoxelWidth thinner =
                width_at_tip(vessel({30, 0, 0}, [](double) { return 0.5; }), 1, voxels);
            CHECK(thinner.is_fading());
        }
    }
    WHEN("it runs obliquely") {
        const VoxelWidth width = width_at_tip(vessel({20, 0, 20}, radius), 1, voxels);
        THEN("the distance counts with the sine of the angle") {
            CHECK(width.voxels == Approx(2.0 * std::sqrt(0.5)));
        }
    }
    WHEN("image and vessel are turned together") {
        const Eigen::Matrix3d turn = skew_rotation();
        const VoxelEdges turned = turn * voxels;
        const VoxelWidth width = width_at_tip(vessel(turn * Vec3(20, 0, 20), radius), 1, turned);
        THEN("nothing changes") {
            CHECK(width.voxels == Approx(2.0 * std::sqrt(0.5)));
        }
    }
    WHEN("it is wide, but for its last stretch") {
        const VoxelWidth width = width_at_tip(
            vessel({40, 0, 0}, [](double share) { return share < 0.85 ? 2.0 : 0.5; }), 1, voxels);
        THEN("the branch is shown up to its end") {
            CHECK(width.diameter == Approx(1.0).epsilon(0.1));
            CHECK(width.lower_quartile == Approx(2.0));
            CHECK_FALSE(width.is_fading());
        }
    }
}

SCENARIO("Closed ends that face each other across a gap are one broken vessel",
         "[geometry][openings]") {
    const auto facing = [](const CenterlineGraph& graph, bool visible = false) {
        std::vector<SurfaceEnd> ends = {closed_end(graph, 1), closed_end(graph, 3)};
        if (visible) ends[1].rim = {0, 1, 2};
        return facing_ends(ends, graph);
    };
    GIVEN("two ends on one line") {
        THEN("they face each other if the gap is at most three diameters") {
            const auto near = facing(two_vessels({-20, 0, 0}, {0, 0, 0}, {25, 0, 0}, {5, 0, 0}));
            CHECK(near[0] == 1);
            CHECK(near[1] == 0);
            const auto far = facing(two_vessels({-20, 0, 0}, {0, 0, 0}, {27, 0, 0}, {7, 0, 0}));
            CHECK_FALSE(far[0]);
            CHECK_FALSE(far[1]);
        }
        THEN("an open one is no broken end") {
            const auto open =
                facing(two_vessels({-20, 0, 0}, {0, 0, 0}, {25, 0, 0}, {5, 0, 0}), true);
            CHECK_FALSE(open[0]);
        }
    }
    GIVEN("two ends side by side, as near") {
        THEN("they do not face each other") {
            CHECK_FALSE(facing(two_vessels({-20, 0, 0}, {0, 0, 0}, {-20, 5, 0}, {0, 5, 0}))[0]);
        }
    }
    GIVEN("an end that points at another one's side") {
        THEN("they do not face each other") {
            CHECK_FALSE(facing(two_vessels({-20, 0, 0}, {0, 0, 0}, {4, -20, 0}, {4, 1, 0}))[0]);
        }
    }
}
