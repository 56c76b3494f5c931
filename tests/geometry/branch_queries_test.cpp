#include "geometry/vessel/centerlines/branch_queries.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/straight_branch.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Parent of radius 2 along x from -20 to 0, a daughter of radius 2 on to 20, one of 1 along y.
CenterlineGraph tree() {
    CenterlineGraph graph;
    graph.nodes = {{{-20, 0, 0}, 2.0, {0}},
                   {{0, 0, 0}, 2.0, {0, 1, 2}},
                   {{20, 0, 0}, 2.0, {1}},
                   {{0, 30, 0}, 1.0, {2}}};
    graph.branches = {straight_branch(0, 1, {-20, 0, 0}, {0, 0, 0}, 2.0),
                      straight_branch(1, 2, {0, 0, 0}, {20, 0, 0}, 2.0),
                      straight_branch(3, 1, {0, 30, 0}, {0, 0, 0}, 1.0)};
    return graph;
}

CenterlineBranch arc(double radius) {
    CenterlineBranch branch{0, 1, {}, {}};
    for (int i = 0; i <= 60; ++i) {
        const double angle = 1.5 * i / 60.0;
        branch.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        branch.radii.push_back(0.3 * radius);
    }
    return branch;
}

double degrees_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / 3.14159265358979;
}

}  // namespace

SCENARIO("Places on a branch are measured along its arc", "[geometry][centerlines]") {
    const CenterlineBranch branch = arc(10.0);
    CHECK(branch_length(branch) == Approx(15.0).epsilon(1e-3));
    THEN("points and tangents are those of the circle, also at the ends") {
        for (const double angle : {0.0, 0.3, 0.75, 1.5}) {
            const double s = branch_length(branch) * angle / 1.5;
            CHECK(
                (point_at(branch, s) - Vec3(10 * std::cos(angle), 10 * std::sin(angle), 0)).norm() <
                0.01);
            CHECK(degrees_between(tangent_at(branch, s),
                                  Vec3(-std::sin(angle), std::cos(angle), 0)) < 0.5);
        }
    }
    THEN("a place outside is clamped") {
        CHECK(point_at(branch, -3.0) == branch.points.front());
        CHECK(radius_at(branch, 99.0) == branch.radii.back());
    }
}

SCENARIO("Tips, directions and furcation zones of a tree", "[geometry][centerlines]") {
    const CenterlineGraph graph = tree();
    THEN("tips are listed by the size of their vessel") {
        const auto tips = tips_by_radius(graph);
        REQUIRE(tips.size() == 3);
        CHECK(tips.back() == 3);
        CHECK(tip_radius(graph, 3) == Approx(1.0));
    }
    THEN("walking inward from a tip stays on its branch") {
        const auto place = inward_from_tip(graph, 3, 10.0);
        REQUIRE(place);
        CHECK((point_at(graph.branches[2], place->abscissa) - Vec3(0, 20, 0)).norm() < 1e-9);
        CHECK_FALSE(inward_from_tip(graph, 3, 31.0));
        CHECK(distance_from_node(graph, *place, 1) == Approx(20.0));
        CHECK(place_from_node(graph, 2, 1, 20.0).abscissa == Approx(place->abscissa));
    }
    THEN("outward is out of the vessel, whichever way the branch runs") {
        CHECK(degrees_between(outward_direction(graph, 3, 2.0), Vec3::UnitY()) < 0.01);
        CHECK(degrees_between(outward_direction(graph, 2, 2.0), Vec3::UnitX()) < 0.01);
        CHECK((beyond_tip(graph, 0, 5.0) - Vec3(-25, 0, 0)).norm() < 1e-6);
    }
    THEN("a side branch is a vessel of its own one radius beyond the parent's wall") {
        CHECK(furcation_zone_end(graph, 2, 1) == Approx(3.0).margin(0.31));
        CHECK(furcation_zone_end(graph, 2, 3) == 0.0);
    }
    THEN("the nearest place and tip are found") {
        const auto nearest = nearest_place(graph, {10.05, -3.0, 0.0});
        REQUIRE(nearest);
        CHECK(nearest->place.branch == 1);
        CHECK(nearest->place.abscissa == Approx(10.05));
        CHECK(nearest->distance == Approx(3.0));
        CHECK(nearest_tip(graph, {0, 25, 0}) == std::size_t{3});
        CHECK_FALSE(nearest_place(CenterlineGraph{}, Vec3::Zero()));
    }
    THEN("asking for what is not there is an error") {
        CHECK_THROWS_AS(branch_of_tip(graph, 1), InvalidInput);
        CHECK_THROWS_AS(distance_from_node(graph, {0, 1.0}, 3), InvalidInput);
    }
}
