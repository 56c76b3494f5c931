#include "meshing/remeshing/local_remesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "meshing/remeshing/local_subdivide.h"
#include "meshing/remeshing/subdivide.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 2.0, kLength = 20.0;  // of the tube [mm]

Surface tube() {
    Surface surface = fine_tube(kRadius, kLength, 24);
    std::vector<double> heights;
    for (const Vec3& p : surface.points()) heights.push_back(p.z());
    surface.attributes["height"] = std::make_shared<const std::vector<double>>(heights);
    return surface;
}

/// A place on the tube's wall, off its vertices.
Vec3 on_wall(double z) {
    return {kRadius * std::cos(0.1), kRadius * std::sin(0.1), z};
}

struct ByPlace {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
};

/// The nearest point of the flat triangles is so far off a place of the round wall, at most [mm].
constexpr double kOff = 0.02;

/// Vertices of the first surface, farther than this from the place, that the second one lacks.
std::size_t lost_beyond(const Surface& before, const Surface& after, const Vec3& at, double reach) {
    std::set<Vec3, ByPlace> places(after.points().begin(), after.points().end());
    return static_cast<std::size_t>(std::ranges::count_if(before.points(), [&](const Vec3& p) {
        return (p - at).norm() > reach + kOff && !places.contains(p);
    }));
}

double mean_edge_within(const Surface& surface, const Vec3& at, double reach) {
    double sum = 0.0, count = 0.0;
    for (const Triangle& t : surface.triangles())
        for (int k = 0; k < 3; ++k) {
            const Vec3 &a = surface.points()[t[k]], &b = surface.points()[t[(k + 1) % 3]];
            if ((0.5 * (a + b) - at).norm() > reach) continue;
            sum += (a - b).norm();
            count += 1.0;
        }
    return sum / count;
}

void check_sound(const Surface& surface) {
    const Connectivity parts = connectivity(*surface.topology);
    CHECK(parts.closed);
    CHECK(parts.manifold);
    CHECK(parts.oriented);
    CHECK(self_intersections(surface).empty());
}

}  // namespace

SCENARIO("Local remeshing refines the surroundings of a place alone", "[meshing][local]") {
    const Surface before = tube();
    const SurfaceDistance places(before);
    for (const double z : {10.0, 0.3, 19.6}) {  // the last two reach rims and caps
        CAPTURE(z);
        const NearPlace near{on_wall(z), 1.5};
        const LocalRemeshed after = remesh_near(before, places, near, 0.15);
        check_sound(after.surface);
        CHECK(mean_edge_within(after.surface, near.at, 1.0) == Approx(0.15).epsilon(0.15));
        CHECK(lost_beyond(before, after.surface, near.at, near.within) == 0);
        CHECK(after.surface.patches == before.patches);
        CHECK(volume(after.surface) == Approx(volume(before)).epsilon(0.002));
        for (const PatchMeasures& patch : measure_patches(after.surface))
            if (patch.kind != PatchKind::Wall) CHECK(patch.flatness < 1e-9);
        for (VertexId v = 0; v < after.surface.vertex_count(); ++v)
            CHECK((*after.surface.attributes.at("height"))[v] ==
                  Approx(after.surface.points()[v].z()).margin(0.05));
    }
}

SCENARIO("Local remeshing keeps the opposite wall", "[meshing][local]") {
    const Surface before = tube();
    const NearPlace near{on_wall(10.0), 4.6};  // more than the diameter, less than half around
    const LocalRemeshed after = remesh_near(before, SurfaceDistance(before), near, 0.4);
    const Vec3 opposite(-kRadius, 0.0, 10.0);
    const auto kept = [&](const Vec3& p) {
        return (p - opposite).norm() > 0.8 ||
               std::ranges::find(after.surface.points(), p) != after.surface.points().end();
    };
    CHECK(std::ranges::all_of(before.points(), kept));
    check_sound(after.surface);
}

SCENARIO("Local remeshing divides triangles larger than the surroundings", "[meshing][local]") {
    const Surface coarse = closed_tube(10.0, 60.0, 8, 6);
    const Vec3 middle =
        0.25 * (coarse.points()[16] + coarse.points()[17] + 2 * coarse.points()[24]);
    const NearPlace near{middle, 1.0};
    const SurfaceDistance places(coarse);
    const LocalRemeshed after = remesh_near(coarse, places, near);
    CHECK(after.report.edge == Approx(0.25));
    CHECK(after.report.edge_before > 5.0);
    check_sound(after.surface);
    CHECK(lost_beyond(coarse, after.surface, near.at, 0.0) == 0);
    CHECK(mean_edge_within(after.surface, near.at, 0.7) == Approx(0.25).epsilon(0.25));
    CHECK(after.surface.triangle_count() < coarse.triangle_count() + 3000);
}

SCENARIO("Local remeshing coarsens as well", "[meshing][local]") {
    const Surface fine = fine_tube(kRadius, kLength, 60);
    const NearPlace near{on_wall(10.0), 2.0};
    const LocalRemeshed after = remesh_near(fine, SurfaceDistance(fine), near, 0.5);
    check_sound(after.surface);
    CHECK(10 * after.report.replacement < 7 * after.report.replaced);
    CHECK(lost_beyond(fine, after.surface, near.at, near.within) == 0);
}

SCENARIO("Local remeshing names what is out of range", "[meshing][local]") {
    const Surface surface = tube();
    const SurfaceDistance places(surface);
    const auto remeshed = [&](double within, double edge) {
        return remesh_near(surface, places, {on_wall(10.0), within}, edge);
    };
    CHECK_THROWS_WITH(remeshed(0.0, 0.1), Catch::Contains("within"));
    CHECK_THROWS_WITH(remeshed(1.0, 0.0), Catch::Contains("edge"));
    CHECK_THROWS_WITH(remeshed(1.0, 2.0), Catch::Contains("edge"));
    CHECK_THROWS_WITH(remeshed(1e4, 1.0), Catch::Contains("within"));
    CHECK_THROWS_WITH(remeshed(2.0, 1e-5), Catch::Contains("million"));
}

SCENARIO("Local subdivision splits and smooths the surroundings of a place", "[meshing][local]") {
    const Surface before = tube();
    const SurfaceDistance places(before);
    const double edge = 2.0 * std::numbers::pi * kRadius / 24;
    for (const int iterations : {1, 2, 3})
        for (const double z : {10.0, 0.3}) {
            CAPTURE(iterations, z);
            const NearPlace near{on_wall(z), 1.5};
            const Surface after = subdivide_near(before, places, near, iterations);
            check_sound(after);
            CHECK(mean_edge_within(after, near.at, 1.2) ==
                  Approx(edge / std::pow(2, iterations)).epsilon(0.15));
            CHECK(lost_beyond(before, after, near.at, near.within) == 0);
            CHECK(after.patches == before.patches);
            CHECK(measure(after).radius_ratio.min > 0.3);
        }
}

SCENARIO("Local subdivision by Loop's rules is that of the whole surface inside",
         "[meshing][local]") {
    const Surface before = icosphere(5.0, 3);
    const NearPlace near{Vec3(0, 0, 5.0), 2.5};
    const Surface after = subdivide_near(before, SurfaceDistance(before), near, 1);
    const Surface whole = subdivide(before, 1);
    for (const Vec3& p : after.points()) {
        if ((p - near.at).norm() > 2.0) continue;
        double nearest = 1.0;
        for (const Vec3& q : whole.points()) nearest = std::min(nearest, (p - q).norm());
        CHECK(nearest < 1e-12);
    }
}
