#include "geometry/vessel/centerlines/lumen_bridges.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kVoxel = 1.0;  // mm

LumenGrid voxels_of(const Surface& surface) {
    return voxelise(surface.points(), surface.triangles(), kVoxel, InsideRule::Winding, {});
}

std::size_t parts_of(LumenGrid grid) {
    return keep_large_components(grid, 0.0);
}

/// A tube of 2 mm radius along z that is much narrower halfway.
Surface tube_with_neck(double neck) {
    return mapped(closed_tube(2.0, 30.0, 32, 90), [&](const Vec3& p) {
        const double away = std::min(1.0, std::abs(p.z() - 15.0) / 3.0);
        const double width = (neck + (2.0 - neck) * away) / 2.0;
        return Vec3(width * p.x(), width * p.y(), p.z());
    });
}

Surface beside(const Surface& first, const Surface& second) {
    Positions points = first.points();
    points.insert(points.end(), second.points().begin(), second.points().end());
    std::vector<Triangle> triangles(first.triangles().begin(), first.triangles().end());
    const auto shift = static_cast<VertexId>(first.vertex_count());
    for (const auto& [a, b, c] : second.triangles())
        triangles.push_back({a + shift, b + shift, c + shift});
    return make_surface(points, triangles);
}

}  // namespace

SCENARIO("A vessel that the grid breaks where it is thin is joined again",
         "[geometry][centerlines][bridges]") {
    // No voxel is as far from the wall of so narrow a neck as those of the lumen are.
    const Surface tube = tube_with_neck(0.7);
    LumenGrid grid = voxels_of(tube);
    REQUIRE(parts_of(grid) == 2);
    bridge_parts(grid, SurfaceDistance(tube), {});
    CHECK(parts_of(grid) == 1);
    CHECK(std::ranges::is_sorted(grid.voxels));
    THEN("its centerline reaches from end to end") {
        const CenterlineGraph graph = compute_centerlines(tube);
        REQUIRE(graph.branches.size() == 1);
        CHECK(branch_length(graph.branches[0]) > 27.0);
    }
}

SCENARIO("Vessels that nearly touch are not joined", "[geometry][centerlines][bridges]") {
    for (const double gap : {0.02, 0.2, 1.0}) {
        const auto along = [&](double x) {
            return mapped(closed_tube(2.0, 30.0, 32, 90),
                          [=](const Vec3& p) { return Vec3(p.x() + x, p.y(), p.z()); });
        };
        const Surface two = beside(along(0.0), along(4.0 + gap));
        LumenGrid grid = voxels_of(two);
        const std::vector<VoxelId> before = grid.voxels;
        REQUIRE(parts_of(grid) == 2);
        bridge_parts(grid, SurfaceDistance(two), {});
        CHECK(grid.voxels == before);
    }
}
