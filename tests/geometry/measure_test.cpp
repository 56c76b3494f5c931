#include "geometry/kernel/measure.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kPi = std::numbers::pi;

Surface moved(const Surface& surface) {
    return mapped(surface,
                  [](const Vec3& p) { return Vec3(skew_rotation() * p + Vec3(500, -300, 70)); });
}

Surface joined(const Surface& a, const Surface& b) {
    Positions points = a.points();
    points.insert(points.end(), b.points().begin(), b.points().end());
    std::vector<Triangle> triangles(a.triangles().begin(), a.triangles().end());
    const auto shift = static_cast<VertexId>(a.vertex_count());
    for (const Triangle& t : b.triangles())
        triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace

SCENARIO("A cube's figures are exact, also far away and turned", "[geometry][measure]") {
    for (const Surface& surface : {cube(2.0), moved(cube(2.0))}) {
        const SurfaceMeasures m = measure(surface);
        CHECK(m.area == Approx(24.0));
        CHECK(m.volume == Approx(8.0));
        CHECK(m.connectivity.closed);
        CHECK(m.connectivity.manifold);
        CHECK(m.connectivity.genus == 0);
        CHECK(m.self_intersections == 0);
        CHECK(m.edge_length.min == Approx(2.0));
        CHECK(m.edge_length.max == Approx(2.0 * std::sqrt(2.0)));
        // A right isosceles triangle: angles 45, 45, 90.
        CHECK(m.equiangle_skewness.max == Approx(0.25));
        CHECK(m.radius_ratio.min == Approx(2.0 * std::sqrt(2.0) - 2.0));
        // Every vertex normal is a space diagonal.
        CHECK(m.normal_curvature_deg == Approx(std::acos(1.0 / std::sqrt(3.0)) * 180.0 / kPi));
    }
}

SCENARIO("A sphere has mean curvature 1/r and integral 4 pi r", "[geometry][measure]") {
    const double radius = 5.0;
    const Surface sphere = icosphere(radius, 4);
    const SurfaceMeasures m = measure(sphere);
    CHECK(m.volume == Approx(4.0 / 3.0 * kPi * radius * radius * radius).epsilon(0.005));
    CHECK(m.mean_curvature_integral == Approx(4.0 * kPi * radius).epsilon(0.005));
    for (const double h : mean_curvature(sphere).values)
        CHECK(h == Approx(1.0 / radius).epsilon(0.01));
    THEN("turned inside out, volume and curvature change their sign") {
        const SurfaceMeasures inward = measure(flipped(sphere));
        CHECK(inward.volume == Approx(-m.volume));
        CHECK(inward.mean_curvature_integral == Approx(-m.mean_curvature_integral));
    }
    THEN("the normal curvature falls with the edge length") {
        CHECK(measure(icosphere(radius, 3)).normal_curvature_deg ==
              Approx(2.0 * m.normal_curvature_deg).epsilon(0.05));
    }
}

SCENARIO("An open tube is measured with virtually closed ends", "[geometry][measure]") {
    const SurfaceMeasures m = measure(open_tube(2.0, 10.0, 64, 20));
    CHECK(m.volume == Approx(kPi * 4.0 * 10.0).epsilon(0.005));
    CHECK(m.connectivity.boundary_loops == 2);
    CHECK_FALSE(m.connectivity.closed);
    CHECK(m.connectivity.genus == 0);
    CHECK(m.mean_curvature_integral_abs == Approx(kPi * 10.0 * 19.0 / 20.0).epsilon(0.01));
}

SCENARIO("Caps are measured as patches", "[geometry][measure]") {
    const auto patches = measure(moved(closed_tube(2.0, 10.0, 64, 20))).patches;
    REQUIRE(patches.size() == 3);
    CHECK(patches[1].name == "inlet");
    CHECK(patches[1].area == Approx(kPi * 4.0).epsilon(0.005));
    CHECK(patches[1].flatness < 1e-9);
    CHECK(patches[1].normal.isApprox(skew_rotation() * Vec3(0, 0, -1), 1e-9));
    CHECK(patches[2].centroid.isApprox(skew_rotation() * Vec3(0, 0, 10) + Vec3(500, -300, 70)));
    CHECK(patches[0].flatness > 1.0);
}

SCENARIO("Places that are no manifold are counted", "[geometry][measure]") {
    GIVEN("two cubes that share an edge") {
        Surface two = joined(
            cube(1.0), mapped(cube(1.0), [](const Vec3& p) { return Vec3(p + Vec3(1, 1, 0)); }));
        std::vector<Triangle> triangles(two.triangles().begin(), two.triangles().end());
        // The second cube's vertices 0 and 4 are the first one's 3 and 7.
        for (Triangle& t : triangles)
            for (VertexId& v : t) v = v == 8 ? 3 : v == 12 ? 7 : v;
        const Connectivity c =
            connectivity(*make_surface(two.points(), std::move(triangles)).topology);
        CHECK(c.non_manifold_edges == 1);
        CHECK_FALSE(c.manifold);
        CHECK_FALSE(c.genus.has_value());
        CHECK(c.components == 1);
    }
    GIVEN("a sphere with one triangle turned over") {
        const Surface sphere = icosphere(1.0, 1);
        std::vector<Triangle> triangles(sphere.triangles().begin(), sphere.triangles().end());
        std::swap(triangles[0][0], triangles[0][1]);
        const Connectivity c =
            connectivity(*make_surface(sphere.points(), std::move(triangles)).topology);
        CHECK(c.inconsistent_edges == 3);
        CHECK(c.manifold);
        CHECK_FALSE(c.oriented);
    }
}

SCENARIO("Two spheres that pass through each other are detected", "[geometry][measure]") {
    CHECK(measure(joined(icosphere(1.0, 2), icosphere(1.0, 2, Vec3(1.5, 0.1, 0.2))))
              .self_intersections > 0);
    CHECK(measure(joined(icosphere(1.0, 2), icosphere(1.0, 2, Vec3(2.5, 0.1, 0.2))))
              .self_intersections == 0);
}

SCENARIO("Crossings of chosen triangles are those of all crossings that contain one",
         "[geometry][measure]") {
    const Surface two = joined(icosphere(1.0, 3), icosphere(1.0, 3, Vec3(1.5, 0.1, 0.2)));
    const auto all = self_intersections(two);
    REQUIRE(all.size() > 20);
    for (const std::size_t step : {1, 3, 200, 100000}) {
        std::vector<std::uint8_t> chosen(two.triangle_count(), 0);
        for (std::size_t t = 5; t < chosen.size(); t += step) chosen[t] = 1;
        std::vector<TrianglePair> expected;
        for (const auto& [s, t] : all)
            if (chosen[s] != 0 || chosen[t] != 0) expected.emplace_back(s, t);
        CHECK(self_intersections_with(two.points(), two.triangles(), chosen) == expected);
    }
    CHECK(self_intersections_with(two.points(), two.triangles(),
                                  std::vector<std::uint8_t>(two.triangle_count(), 0))
              .empty());
    CHECK_THROWS_AS(self_intersections_with(two.points(), two.triangles(), {}), InvalidInput);
}

SCENARIO("Concentric spheres differ by their radii", "[geometry][measure]") {
    const auto c = compare_with_reference(icosphere(10.5, 4), icosphere(10.0, 4));
    CHECK(c.hausdorff == Approx(0.5).epsilon(0.05));
    CHECK(c.mean_distance == Approx(0.5).epsilon(0.02));
    CHECK(c.volume_change_percent == Approx(100.0 * (1.05 * 1.05 * 1.05 - 1.0)).epsilon(0.01));
    REQUIRE(c.local_error);
    CHECK(c.local_error->mean == Approx(0.5).epsilon(0.02));
    CHECK(c.local_error->largest == Approx(0.5).epsilon(0.02));
    THEN("surfaces of other triangles have no local error") {
        CHECK_FALSE(compare_with_reference(icosphere(10.0, 3), icosphere(10.0, 4)).local_error);
    }
    THEN("a surface does not differ from itself") {
        const auto same = compare_with_reference(icosphere(10.0, 3), icosphere(10.0, 3));
        CHECK(same.hausdorff < 1e-12);
        CHECK(same.local_error->largest == 0.0);
        CHECK(same.volume_change_percent == Approx(0.0).margin(1e-12));
    }
}

SCENARIO("An empty surface cannot be measured, nor one without area compared",
         "[geometry][measure]") {
    CHECK_THROWS_AS(measure(Surface{}), InvalidInput);
    const Surface sphere = icosphere(1.0, 1);
    for (const Vec3& far : {Vec3(3, 0, 0), Vec3(0, 0, 0)}) {
        const Surface flat = make_surface({{0, 0, 0}, 0.5 * far, far}, {{0, 1, 2}});
        CHECK_THROWS_WITH(compare_with_reference(flat, sphere), Catch::Contains("an area"));
        CHECK_THROWS_WITH(compare_with_reference(sphere, flat), Catch::Contains("an area"));
    }
}
