#include "smoothing/brush/geodesic_neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_distance.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A square of edge 10 mm in z = 0 whose triangles are sheared, so that many are obtuse.
Surface sheared_plane(int cells) {
    Positions points;
    std::vector<Triangle> triangles;
    const double step = 10.0 / cells;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            points.emplace_back(i * step + 0.8 * j * step, j * step, 0.0);
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto at = [&](int a, int b) {
                return static_cast<VertexId>((j + b) * (cells + 1) + i + a);
            };
            triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    return make_surface(points, triangles);
}

/// Plane z = 0 from 0 to `edge` with n x n squares, their inner corners moved at random, each cut
/// along one or the other diagonal.
Surface uneven_plane(double edge, int n, double unevenness) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-unevenness, unevenness);
    Positions points;
    std::vector<Triangle> triangles;
    const auto at = [&](int i, int j) { return static_cast<VertexId>(i * (n + 1) + j); };
    const auto inner = [&](int i) { return i > 0 && i < n; };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const double dx = inner(i) ? shift(random) : 0.0, dy = inner(j) ? shift(random) : 0.0;
            points.emplace_back((i + dx) * edge / n, (j + dy) * edge / n, 0.0);
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const VertexId a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            if ((i + j) % 3 == 0) {
                triangles.push_back({a, b, c});
                triangles.push_back({a, c, d});
            } else {
                triangles.push_back({a, b, d});
                triangles.push_back({b, c, d});
            }
        }
    return make_surface(std::move(points), std::move(triangles));
}

std::vector<GeodesicNeighbour> around(const Surface& surface, const Vec3& where, double radius) {
    GeodesicNeighbourhood search(*surface.topology);
    const SurfacePoint place = SurfaceDistance(surface).closest_point(where);
    const auto found = search.within(surface.points(), place.triangle, place.point, radius);
    return {found.begin(), found.end()};
}

}  // namespace

SCENARIO("Geodesic distances on a plane are Euclidean", "[smoothing][geodesic]") {
    const Surface plane = sheared_plane(40);
    const Vec3 middle(9.03, 5.07, 0.0);
    const auto found = around(plane, middle, 3.0);
    std::size_t expected = 0;
    for (const Vec3& p : plane.points()) expected += (p - middle).norm() <= 3.0 ? 1 : 0;
    CHECK(found.size() == expected);
    REQUIRE(found.size() > 300);
    for (const auto& [v, distance] : found)
        CHECK(distance == Approx((plane.points()[v] - middle).norm()).epsilon(1e-5));
}

SCENARIO("Geodesic distances on a sphere are arcs", "[smoothing][geodesic]") {
    const double radius = 10.0;
    const Surface sphere = icosphere(radius, 5);
    const Vec3 pole = radius * Vec3(0.3, -0.5, 0.8).normalized();
    const auto found = around(sphere, pole, 12.0);
    REQUIRE(found.size() > 1000);
    double worst = 0.0;
    for (const auto& [v, distance] : found) {
        const double arc =
            radius * std::acos(std::min(1.0, sphere.points()[v].normalized().dot(pole) / radius));
        if (arc > 1.0) worst = std::max(worst, std::abs(distance / arc - 1.0));
    }
    CHECK(worst < 0.01);
}

SCENARIO("A search depends neither on the previous one nor on the surface's size",
         "[smoothing][geodesic]") {
    const Surface sphere = icosphere(10.0, 4);
    GeodesicNeighbourhood search(*sphere.topology);
    const auto at = [&](TriangleId t) {
        const auto found =
            search.within(sphere.points(), t, sphere.points()[sphere.triangles()[t][0]], 3.0);
        return std::vector<GeodesicNeighbour>(found.begin(), found.end());
    };
    const auto first = at(17);
    CHECK(at(900) != first);
    CHECK(at(17) == first);
    CHECK(std::ranges::is_sorted(first, {}, &GeodesicNeighbour::vertex));
}

SCENARIO("Vertices near in space, but far along the surface, are not visited",
         "[smoothing][geodesic]") {
    GIVEN("two tubes 0.3 mm apart") {
        const Surface tube = open_tube(1.0, 10.0, 48, 80);
        const Surface both =
            merged(tube, mapped(tube, [](const Vec3& p) { return Vec3(p + Vec3(2.3, 0, 0)); }));
        for (const auto& [v, distance] : around(both, Vec3(1.0, 0.0, 5.0), 2.0))
            CHECK(both.points()[v].x() <= 1.0);
    }
    GIVEN("a sheet that is folded over itself, 0.1 mm apart") {
        const Surface flat = sheared_plane(80);
        const double gap = 0.1;
        const Surface folded = mapped(flat, [&](const Vec3& p) {
            return p.y() <= 5.0 ? p : Vec3(p.x(), 10.0 - p.y() + 0.1, gap);
        });
        const auto found = around(folded, Vec3(8.0, 3.0, 0.0), 1.5);
        REQUIRE(found.size() > 100);
        for (const auto& [v, distance] : found) CHECK(folded.points()[v].z() == 0.0);
    }
}

SCENARIO("Needle triangles do not spoil geodesic distances", "[smoothing][geodesic]") {
    const Surface plane = mapped(uneven_plane(10.0, 40, 0.3),
                                 [](const Vec3& p) { return Vec3(p.x(), 0.05 * p.y(), 0.0); });
    const Vec3 source(5.03, 0.24, 0.0);
    const auto found = around(plane, source, 2.0);
    std::size_t inside = 0;
    for (const Vec3& p : plane.points()) inside += (p - source).norm() <= 2.0 ? 1 : 0;
    CHECK(found.size() == inside);
    for (const auto& [v, distance] : found)
        CHECK(distance == Approx((plane.points()[v] - source).norm()).epsilon(1e-4).margin(1e-6));
}

SCENARIO("Distances go around the bend of a folded sheet", "[smoothing][geodesic]") {
    // A sheet of 10 mm by 10 mm, bent double at x = 5 with 0.2 mm between its halves.
    const double gap = 0.2, bend = 0.5 * std::numbers::pi * gap;
    const Surface flat = uneven_plane(10.0, 80, 0.2);
    const auto fold = [&](const Vec3& p) {
        const double s = p.x() - 5.0, turn = s / (0.5 * gap);
        if (s < 0.0) return Vec3(s, p.y(), 0.0);
        if (s < bend)
            return Vec3(0.5 * gap * std::sin(turn), p.y(), 0.5 * gap * (1.0 - std::cos(turn)));
        return Vec3(-(s - bend), p.y(), gap);
    };
    const Surface sheet = mapped(flat, fold);
    const Vec3 source(3.5, 5.0, 0.0);
    for (const auto& [v, distance] : around(sheet, fold(source), 1.4))
        CHECK(flat.points()[v].x() < 5.0);
    double farthest = 0.0;
    for (const auto& [v, distance] : around(sheet, fold(source), 2.5)) {
        CHECK(distance == Approx((flat.points()[v] - source).norm()).epsilon(0.05));
        farthest = std::max(farthest, flat.points()[v].x());
    }
    CHECK(farthest > 5.8);
}

SCENARIO("Bad places and radii are refused, bad triangles are left out", "[smoothing][geodesic]") {
    const Surface sphere = icosphere(10.0, 2);
    GeodesicNeighbourhood search(*sphere.topology);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Vec3& corner = sphere.points()[sphere.triangles()[0][0]];
    CHECK_THROWS_AS(search.within(sphere.points(), 0, corner, 0.0), InvalidInput);
    CHECK_THROWS_AS(search.within(sphere.points(), 0, corner, nan), InvalidInput);
    CHECK_THROWS_AS(search.within(sphere.points(), 5000, corner, 1.0), InvalidInput);
    CHECK_THROWS_AS(search.within(sphere.points(), 0, Vec3(nan, 0, 0), 1.0), InvalidInput);
    CHECK_THROWS_AS(search.within({}, 0, corner, 1.0), InvalidInput);
    Positions broken = sphere.points();
    broken[sphere.triangles()[0][1]] = Vec3(nan, 0, 0);
    broken[sphere.triangles()[200][0]] = broken[sphere.triangles()[200][1]];
    const auto found = search.within(broken, 0, corner, 50.0);
    CHECK(found.size() == sphere.vertex_count() - 1);
    for (const auto& [v, distance] : found) CHECK(std::isfinite(distance));
}
