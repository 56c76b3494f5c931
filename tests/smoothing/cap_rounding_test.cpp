#include "smoothing/context/cap_rounding.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface domed(const Surface& surface, double height = 1.0) {
    return surface.with_positions(rounded_caps(surface, find_caps(surface), height));
}

/// The tube of radius 3 from z = 0 to 12 with its upper end cut obliquely.
Surface cut_obliquely(double slope) {
    return mapped(fine_tube(3.0, 12.0, 48), [=](const Vec3& p) {
        return Vec3(p.x(), p.y(), p.z() * (1.0 + slope * p.x() / 12.0));
    });
}

/// A tube whose cross-section is bent like a bean.
Surface bean() {
    return mapped(fine_tube(3.0, 12.0, 48), [](const Vec3& p) {
        const double radius = 4.0 + 0.6 * p.y(), angle = 0.55 * p.x();
        return Vec3(radius * std::sin(angle), radius * std::cos(angle), p.z());
    });
}

/// Largest angle between a cap's triangle at the rim and the wall's beyond it [deg].
double largest_fold_deg(const Surface& surface, const Cap& cap) {
    double largest = 0.0;
    const auto inside = [&](TriangleId t) {
        return std::binary_search(cap.triangles.begin(), cap.triangles.end(), t);
    };
    const CompressedRows& at = surface.topology->triangles_at();
    for (const TriangleId t : cap.triangles)
        for (int k = 0; k < 3; ++k)
            for (const TriangleId other : at.row(surface.triangles()[t][k])) {
                const Triangle& o = surface.triangles()[other];
                const VertexId b = surface.triangles()[t][(k + 1) % 3];
                if (inside(other) || std::find(o.begin(), o.end(), b) == o.end()) continue;
                const Vec3 n = area_normal(surface.points(), surface.triangles()[t]).normalized();
                const Vec3 m = area_normal(surface.points(), o).normalized();
                largest = std::max(largest, std::acos(std::min(1.0, n.dot(m))) * 180.0 / M_PI);
            }
    return largest;
}

}  // namespace

SCENARIO("Rounded caps are domes on the wall, which stays", "[smoothing][cap-rounding]") {
    const Surface tube = fine_tube(3.0, 12.0, 48);
    const auto caps = find_caps(tube);
    REQUIRE(caps.size() == 2);
    const auto flags = cap_vertices(caps, tube.vertex_count());
    for (const double height : {1.0, 0.5}) {
        const Surface round = domed(tube, height);
        double highest = 0.0;
        for (std::size_t v = 0; v < flags.size(); ++v) {
            const Vec3 &before = tube.points()[v], &after = round.points()[v];
            if (flags[v] == 0) REQUIRE(after == before);
            const double z = (after.z() < 6.0 ? -after.z() : after.z() - 12.0) / height;
            if (flags[v] != 0)  // half an ellipsoid on each end
                CHECK(std::hypot(std::hypot(after.x(), after.y()), z) == Approx(3.0).epsilon(0.02));
            highest = std::max(highest, z * height);
        }
        CHECK(highest == Approx(3.0 * height).epsilon(0.01));
        CHECK(enclosed_volume(round) == Approx(M_PI * 9.0 * (12.0 + height * 4.0)).epsilon(0.02));
        for (const Cap& cap : caps)
            for (const VertexId v : cap.rim) CHECK(round.points()[v] == tube.points()[v]);
    }
    CHECK(rounded_caps(tube, {}) == tube.points());
}

SCENARIO("A dome continues in the wall's direction", "[smoothing][cap-rounding]") {
    for (const double slope : {0.0, 0.3, 0.8}) {
        CAPTURE(slope);
        const Surface tube = cut_obliquely(slope);
        const Surface round = domed(tube);
        for (const Cap& cap : find_caps(tube)) {
            const double before = largest_fold_deg(tube, cap);
            CHECK(before > 88.0);
            CHECK(largest_fold_deg(round, cap) < 0.3 * before);  // 11 degrees are a row's own bend
        }
        for (const Vec3& p : round.points()) CHECK(std::hypot(p.x(), p.y()) < 3.45);
    }
}

SCENARIO("Domes neither fold nor pass through themselves", "[smoothing][cap-rounding]") {
    const Surface turned =
        mapped(cut_obliquely(0.8), [](const Vec3& p) { return Vec3(skew_rotation() * p); });
    for (const Surface& surface :
         {fine_tube(3.0, 12.0, 48), closed_tube(3.0, 12.0, 16, 8), turned, bean()}) {
        const auto caps = find_caps(surface);
        REQUIRE(caps.size() == 2);
        const Surface round = domed(surface);
        CHECK(self_intersections(round).empty());
        CHECK(enclosed_volume(round) > 1.1 * enclosed_volume(surface));
        for (const Cap& cap : caps)
            for (const TriangleId t : cap.triangles)  // a dome leans by up to 45 degrees
                CHECK(area_normal(round.points(), surface.triangles()[t])
                          .normalized()
                          .dot(cap.normal) > -0.75);
    }
}

SCENARIO("A cap of one fan becomes a cone", "[smoothing][cap-rounding]") {
    const Surface tube = closed_tube(3.0, 12.0, 96, 8);
    CHECK(enclosed_volume(domed(tube)) == Approx(M_PI * 9.0 * (12.0 + 2.0)).epsilon(0.01));
}

SCENARIO("Domes do not depend on threads, and accept any surface", "[smoothing][cap-rounding]") {
    const Surface surface = bean();
    const Positions round = rounded_caps(surface, find_caps(surface));
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(rounded_caps(surface, find_caps(surface)) == round);
    }
    CHECK_THROWS_WITH(rounded_caps(surface, {}, 0.0), Catch::Contains("height"));
    CHECK_THROWS_WITH(rounded_caps(surface, {}, std::nan("")), Catch::Contains("height"));
    CHECK(rounded_caps(make_surface({}, {}), {}).empty());
    const Surface sheet = make_surface(  // all patch, open, with a degenerate triangle
        {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-2, -2, 0}, {0, 0, 0}, {5, 5, 5}},
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 0, 1}, {0, 4, 0}}, {1, 1, 1, 1, 1},
        {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}});
    for (const Vec3& p : rounded_caps(sheet, find_caps(sheet))) CHECK(p.allFinite());
}
