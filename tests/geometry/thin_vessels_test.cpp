#include "geometry/vessel/centerlines/thin_vessels.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kVoxel = 1.0;  // mm

/// A closed tube of 50 mm along z.
Surface tube(const std::function<double(double)>& radius_at) {
    return mapped(closed_tube(1.0, 50.0, 32, 120), [&](const Vec3& p) {
        const double radius = radius_at(p.z());
        return Vec3(radius * p.x(), radius * p.y(), p.z());
    });
}

LumenGrid voxels_of(const Surface& surface) {
    return voxelise(surface.points(), surface.triangles(), kVoxel, InsideRule::Winding, {});
}

LumenGrid with_thin_vessels(const Surface& surface) {
    LumenGrid grid = voxels_of(surface);
    add_thin_vessels(grid, vessel_wall_of(surface), {});
    CHECK(std::ranges::is_sorted(grid.voxels));
    return grid;
}

std::size_t parts_of(LumenGrid grid) {
    return keep_large_components(grid, 0.0);
}

double top_of(const LumenGrid& grid) {
    double top = 0.0;
    for (const VoxelId v : grid.voxels) top = std::max(top, grid.centre(v).z());
    return top;
}

}  // namespace

SCENARIO("A vessel that goes on thinner than the grid's voxels is followed to its end",
         "[geometry][centerlines][thin]") {
    const Surface tail =
        tube([](double z) { return std::clamp(2.5 - 0.4 * (z - 20.0), 0.25, 2.5); });
    REQUIRE(top_of(voxels_of(tail)) < 27.0);
    const LumenGrid grid = with_thin_vessels(tail);
    CHECK(top_of(grid) > 48.0);
    CHECK(parts_of(grid) == 1);
}

SCENARIO("Parts that a long thin stretch joins become one", "[geometry][centerlines][thin]") {
    const Surface neck =
        tube([](double z) { return std::clamp(0.4 * (std::abs(z - 25.0) - 10.0), 0.25, 2.5); });
    REQUIRE(parts_of(voxels_of(neck)) == 2);
    CHECK(parts_of(with_thin_vessels(neck)) == 1);
}

SCENARIO("A thin vessel is not joined to another one that it nearly touches",
         "[geometry][centerlines][thin]") {
    const Surface tail =
        tube([](double z) { return std::clamp(2.5 - 0.4 * (z - 20.0), 0.25, 2.5); });
    const Surface other = mapped(closed_tube(2.0, 30.0, 32, 90), [](const Vec3& p) {
        return Vec3(p.z() - 15.0, p.x() + 2.3, p.y() + 40.0);  // 0.05 mm beside it
    });
    CHECK(parts_of(with_thin_vessels(merged(tail, other))) == 2);
}

SCENARIO("Corners and rounded tips of vessels that the grid shows are no thin vessels",
         "[geometry][centerlines][thin]") {
    for (const Surface& surface :
         {tube([](double) { return 2.0; }),
          tube([](double z) { return z < 47.5 ? 2.5 : std::sqrt(6.3 - (z - 47.5) * (z - 47.5)); })})
        CHECK(with_thin_vessels(surface).voxels == voxels_of(surface).voxels);
}
