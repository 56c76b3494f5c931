#include "geometry/vessel/artefacts/wall_relief.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/vessel/artefacts/short_branches.h"
#include "tests/support/shapes.h"
#include "tests/support/straight_branch.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 2.0, kLength = 24.0;

/// The line of a tube along z.
CenterlineGraph tube_line() {
    CenterlineGraph graph;
    graph.nodes = {{Vec3(0, 0, 0), kRadius, {0}}, {Vec3(0, 0, kLength), kRadius, {0}}};
    graph.branches = {
        straight_branch(0, 1, graph.nodes[0].position, graph.nodes[1].position, kRadius)};
    return graph;
}

/// A flattened tube, whose wall is moved outward by `height` [mm] around a place on it.
Surface tube_with_spot(double height, double size) {
    const Vec3 at(kRadius * 1.2, 0, 12);
    return mapped(fine_tube(kRadius, kLength, 48), [&](const Vec3& p) {
        const Vec3 flat(1.2 * p.x(), 0.9 * p.y(), p.z());
        const double share = (flat - at).norm() / size;
        if (share >= 1.0) return flat;
        const double up = (1 - share * share) * (1 - share * share);
        return Vec3(flat + height * up * Vec3::UnitX());
    });
}

std::vector<WallSpot> spots_of(const Surface& surface) {
    return wall_spots(surface, wall_relief(surface, tube_line()));
}

}  // namespace

SCENARIO("A flattened tube lies on its own smooth tube", "[geometry][wall-relief]") {
    const Surface tube = tube_with_spot(0.0, 1.0);
    const WallRelief relief = wall_relief(tube, tube_line());
    std::size_t known = 0;
    for (const double height : relief.heights) {
        if (std::isnan(height)) continue;
        ++known;
        CHECK(std::abs(height) < 0.02);
    }
    CHECK(known > tube.vertex_count() / 2);
    CHECK(spots_of(tube).empty());
}

SCENARIO("A bump and a dent are spots of their height and place", "[geometry][wall-relief]") {
    for (const double height : {0.6, -0.6}) {
        const auto spots = spots_of(tube_with_spot(height, 1.2));
        REQUIRE(spots.size() == 1);
        CHECK(spots[0].height == Approx(height).epsilon(0.15));
        CHECK((spots[0].place - Vec3(1.2 * kRadius + height, 0, 12)).norm() < 0.3);
        CHECK(spots[0].size < 1.2);
        CHECK(spots[0].radius == Approx(kRadius));
    }
}

SCENARIO("Caps and ends of a tube are no part of its relief", "[geometry][wall-relief]") {
    const Surface tube = tube_with_spot(0.0, 1.0);
    const WallRelief relief = wall_relief(tube, tube_line());
    for (VertexId v = 0; v < tube.vertex_count(); ++v) {
        const double z = tube.points()[v].z();
        if (z < 0.5 * kRadius || z > kLength - 0.5 * kRadius) CHECK(std::isnan(relief.heights[v]));
    }
}

SCENARIO("A surface without lines has no relief", "[geometry][wall-relief]") {
    const Surface ball = icosphere(1.0, 2);
    const WallRelief relief = wall_relief(ball, {});
    CHECK(wall_spots(ball, relief).empty());
}

SCENARIO("A bulge without a line is a short branch if it rises enough", "[geometry][stubs]") {
    const Surface tube = fine_tube(kRadius, kLength, 24);
    const auto bulge = [](double length) {
        return Stub{.root = Vec3(0, 0, 12),
                    .exit = Vec3(kRadius, 0, 12),
                    .tip = Vec3(kRadius + length, 0, 12),
                    .length = length,
                    .widest = 0.8,
                    .parent = kRadius};
    };
    const std::vector<Stub> stubs = {bulge(1.5), bulge(0.2)};
    const auto found = short_branches(tube, tube_line(), stubs);
    REQUIRE(found.size() == 1);
    CHECK(found[0].length == 1.5);
    CHECK(found[0].diameter == 1.6);
    CHECK_FALSE(found[0].has_line);
}
