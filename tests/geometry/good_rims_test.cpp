#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/openings/rim_shape.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 2.0, kLength = 30.0;

CenterlineGraph line_graph(double from = 0.0, double to = kLength) {
    CenterlineBranch branch{.start_node = 0, .end_node = 1, .points = {}, .radii = {}};
    for (int i = 0; i <= 100; ++i) {
        branch.points.emplace_back(0, 0, from + (to - from) * i / 100);
        branch.radii.push_back(kRadius);
    }
    return {.nodes = {{branch.points.front(), kRadius, {0}}, {branch.points.back(), kRadius, {0}}},
            .branches = {branch}};
}

/// A tube whose upper rim is moved by a function of its place, less and less towards the middle.
Surface tube_with_end(const std::function<double(const Vec3&)>& rise) {
    return mapped(open_tube(kRadius, kLength, 40, 90), [&](const Vec3& p) {
        const double share = std::max(0.0, (p.z() - 15.0) / 15.0);
        return Vec3(p.x(), p.y(), p.z() + share * rise(p));
    });
}

}  // namespace

SCENARIO("A flat open rim is capped as it is", "[geometry][openings]") {
    GIVEN("a tube whose upper end is oblique by 39 degrees") {
        const double slope = std::tan(39.0 * M_PI / 180.0);
        const Surface tube = tube_with_end([&](const Vec3& p) { return slope * p.x(); });
        const OpeningPlan plan = plan_openings(tube, line_graph());
        REQUIRE(plan.openings.size() == 2);
        for (const PlannedOpening& opening : plan.openings)
            CHECK(opening.way == OpeningWay::CapRim);
        const Surface capped = clip_openings(tube, plan).surface;
        THEN("no vertex moves, and the caps close the rims") {
            CHECK(is_closed_manifold(capped));
            for (VertexId v = 0; v < tube.vertex_count(); ++v)
                CHECK((capped.points()[v] - tube.points()[v]).norm() < 1e-9);
            const Vec3 oblique = Vec3(-slope, 0, 1).normalized();
            const std::size_t upper =
                patch_shape(capped, 1).plane.point.z() > 15.0 ? std::size_t{1} : std::size_t{2};
            CHECK(angle_deg(patch_shape(capped, upper).plane.normal, oblique) < 1e-3);
        }
        THEN("the record names the tilt") {
            REQUIRE(plan.ends.size() == 2);
            CHECK(plan.ends[0].fate == EndFate::Kept);
            const std::string whole = plan.ends[0].why + plan.ends[1].why;
            CHECK_THAT(whole, Catch::Contains("39 degrees"));
        }
    }
    GIVEN("a rim that is flat within 3 degrees, and one that is not") {
        const auto wavy = [](double height) {
            return tube_with_end(
                [=](const Vec3& p) { return height * std::cos(2.0 * std::atan2(p.y(), p.x())); });
        };
        const double limit = kRadius * std::tan(kFlatRimDeg * M_PI / 180.0);
        const auto ways = [&](double height) {
            const Surface tube = wavy(height);
            const OpeningPlan plan = plan_openings(tube, line_graph());
            const Surface made = clip_openings(tube, plan).surface;
            CHECK(is_closed_manifold(made));
            for (std::size_t p = 1; p < made.patches.size(); ++p)
                CHECK(patch_shape(made, p).flatness < 1e-9);
            return std::count_if(plan.openings.begin(), plan.openings.end(),
                                 [](const auto& o) { return o.way == OpeningWay::CapRim; });
        };
        CHECK(ways(0.9 * limit) == 2);
        CHECK(ways(1.2 * limit) == 1);
    }
    GIVEN("a short vessel with a flat rim, where no centerline ends") {
        const Surface tube = open_tube(kRadius, kLength, 40, 90);
        const OpeningPlan plan = plan_openings(tube, line_graph(8.0, kLength));
        THEN("the rim is capped whatever lies behind it") {
            CHECK(is_closed_manifold(clip_openings(tube, plan).surface));
            CHECK(std::ranges::count(plan.openings, OpeningWay::CapRim, &PlannedOpening::way) == 2);
        }
    }
}

SCENARIO("A hole in a vessel's side is not a good rim", "[geometry][openings]") {
    const Surface tube = open_tube(kRadius, kLength, 40, 90);
    std::vector<Triangle> triangles;
    for (const Triangle& t : tube.triangles()) {
        const Vec3 middle = (tube.points()[t[0]] + tube.points()[t[1]] + tube.points()[t[2]]) / 3.0;
        if ((middle - Vec3(kRadius, 0, 15)).norm() > 1.0) triangles.push_back(t);
    }
    const Surface holed = make_surface(tube.points(), triangles);
    const auto loops = holed.topology->boundary_loops();
    REQUIRE(loops.size() == 3);
    int good = 0;
    for (const auto& loop : loops) {
        const RimShape rim = rim_shape(holed, loop);
        good += rim.is_good() ? 1 : 0;
        CHECK((rim.rise_deg > 89.0 || rim.rise_deg < 30.0));
    }
    CHECK(good == 2);
    THEN("it is closed as wall, and said") {
        const OpeningPlan plan = plan_openings(holed, line_graph());
        CHECK(plan.openings.size() == 2);
        REQUIRE(plan.ends.size() == 3);
        CHECK(plan.ends[0].fate == EndFate::Closed);
        const Surface made = clip_openings(holed, plan).surface;
        CHECK(is_closed_manifold(made));
        CHECK(made.patches.size() == 3);
    }
}

SCENARIO("Ends cut by hand are not cut again", "[geometry][openings]") {
    const Surface tube = tube_with_end([](const Vec3& p) { return 0.3 * std::sin(7.0 * p.x()); });
    OpeningPlan by_hand = plan_openings(tube, line_graph(), {.tip = Vec3(0, 0, 30), .distance = 8});
    by_hand.openings[0].place.plane.normal = Vec3(0.4, 0, 1).normalized();
    by_hand.openings[0].patch = Patch{"femoral", PatchKind::Outlet};
    const Surface one = clip_openings(tube, by_hand).surface;
    const OpeningPlan rest = plan_openings(one, line_graph(0.0, 22.0));
    const Surface both = clip_openings(one, rest).surface;
    REQUIRE(both.patches.size() == 3);
    const std::size_t femoral = both.patches[1].name == "femoral" ? 1 : 2;
    CHECK(both.patches[femoral] == Patch{"femoral", PatchKind::Outlet});
    CHECK(angle_deg(patch_shape(both, femoral).plane.normal, Vec3(0.4, 0, 1)) < 1e-6);
}
