#include "meshing/remeshing/decimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>
#include <string_view>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface decimated(const Surface& surface, std::size_t triangles,
                  std::span<const double> weights = {}) {
    return decimate(surface, {.triangles = triangles}, weights).surface;
}

Surface torus() {
    const auto shape = [](const Vec3& p) {
        return std::hypot(std::hypot(p.x(), p.y()) - 8.0, p.z()) - 3.0;
    };
    return iso_surface(shape, {Vec3(-12, -12, -4), Vec3(12, 12, 4)}, 0.5);
}

/// Two capsules that meet: a bend with a crease.
Surface branching() {
    const auto shape = [](const Vec3& p) {
        return std::min(capsule(p, Vec3(0, 0, -10), Vec3(0, 0, 10), 2.5),
                        capsule(p, Vec3(0, 0, 0), Vec3(9, 0, 6), 1.8));
    };
    return iso_surface(shape, {Vec3(-4, -4, -14), Vec3(12, 4, 14)}, 0.5);
}

std::size_t triangles_where(const Surface& surface, const std::function<bool(const Vec3&)>& where) {
    return std::ranges::count_if(surface.triangles(), [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](VertexId v) { return where(surface.points()[v]); });
    });
}

std::vector<double> weights_by(const Surface& surface,
                               const std::function<double(const Vec3&)>& weight) {
    std::vector<double> weights;
    for (const Vec3& p : surface.points()) weights.push_back(weight(p));
    return weights;
}

}  // namespace

SCENARIO("A decimated sphere is still that sphere", "[meshing][decimate]") {
    const Surface sphere = icosphere(10.0, 5);  // 20480 triangles
    const auto [share, furthest, volume_lost] =
        GENERATE(table<double, double, double>({{0.25, 0.012, 1e-3}, {0.02, 0.18, 0.013}}));
    const auto count = static_cast<std::size_t>(share * 20480.0);
    const Surface coarse = decimated(sphere, count);
    CHECK(coarse.triangle_count() <= count);
    CHECK(coarse.triangle_count() + 2 > count);
    CHECK(is_closed_manifold(coarse));
    CHECK(connectivity(*coarse.topology).genus == 0);
    CHECK(volume(coarse) == Approx(volume(sphere)).epsilon(volume_lost));
    const auto found = compare_with_reference(coarse, sphere);
    CHECK(found.hausdorff < furthest);
    CHECK(measure(coarse).equiangle_skewness.max < 0.8);
    for (const Triangle& t : coarse.triangles())
        CHECK(area_normal(coarse.points(), t).dot(coarse.points()[t[0]]) > 0.0);
}

SCENARIO("Handles, branches and components are kept", "[meshing][decimate]") {
    const Surface ring = torus(), tree = branching();
    CHECK(connectivity(*decimated(ring, 300).topology).genus == 1);
    CHECK(is_closed_manifold(decimated(tree, 300)));
    const Surface two = merged(icosphere(10.0, 4), icosphere(0.2, 3, Vec3(30, 0, 0)));
    const Surface coarse = decimated(two, 200);
    CHECK(connectivity(*coarse.topology).components == 2);
    CHECK(is_closed_manifold(coarse));
    for (const Surface& surface : {decimated(ring, 300), decimated(tree, 300)}) {
        CHECK(self_intersections(surface).empty());
        CHECK(measure(surface).equiangle_skewness.max < 0.95);
    }
}

SCENARIO("Caps stay flat and labelled, and their rims on the circle", "[meshing][decimate]") {
    Surface tube = fine_tube(2.0, 16.0, 48);
    std::vector<double> heights;
    for (const Vec3& p : tube.points()) heights.push_back(p.z());
    tube.attributes["height"] = std::make_shared<const std::vector<double>>(heights);
    const Surface coarse = decimated(tube, tube.triangle_count() / 10);
    CHECK(is_closed_manifold(coarse));
    CHECK(coarse.patches == tube.patches);
    REQUIRE(measure_patches(coarse).size() == 3);
    for (const PatchMeasures& patch : measure_patches(coarse)) {
        if (patch.kind == PatchKind::Wall) continue;
        CHECK(patch.flatness < 1e-9);
        CHECK(patch.area == Approx(4.0 * std::acos(-1.0)).epsilon(0.05));
    }
    for (VertexId v = 0; v < coarse.vertex_count(); ++v)
        CHECK((*coarse.attributes.at("height"))[v] == Approx(coarse.points()[v].z()).margin(0.05));
    CHECK(volume(coarse) == Approx(volume(tube)).epsilon(0.02));
}

SCENARIO("Open boundaries keep some of their vertices as they are", "[meshing][decimate]") {
    const Surface tube = open_tube(2.0, 12.0, 48, 40);
    const Surface coarse = decimated(tube, 400);
    const auto loops = coarse.topology->boundary_loops();
    REQUIRE(loops.size() == 2);
    for (const auto& loop : loops) {
        CHECK(loop.size() >= 8);
        for (const VertexId v : loop)
            CHECK(std::ranges::count(tube.points(), coarse.points()[v]) == 1);
    }
}

SCENARIO("Planar parts collapse to almost nothing, at no distance", "[meshing][decimate]") {
    const Surface box =
        iso_surface([](const Vec3& p) { return (p.cwiseAbs() - Vec3(5, 5, 5)).maxCoeff(); },
                    {Vec3(-6, -6, -6), Vec3(6, 6, 6)}, 1.0);
    const std::size_t before = box.triangle_count();
    const Decimated coarse = decimate(box, {.max_error = 1e-6});
    CHECK(coarse.surface.triangle_count() < before / 8);
    CHECK(compare_with_reference(coarse.surface, box).hausdorff < 1e-6);
    CHECK(is_closed_manifold(coarse.surface));
}

SCENARIO("A largest error holds in both directions", "[meshing][decimate]") {
    const Surface surface = GENERATE_COPY(branching(), torus(), open_tube(3.0, 20.0, 60, 80));
    std::size_t last = surface.triangle_count();
    for (const double error : {0.02, 0.1, 0.3}) {
        const Decimated coarse = decimate(surface, {.max_error = error});
        CAPTURE(error, coarse.surface.triangle_count());
        CHECK(compare_with_reference(coarse.surface, surface).hausdorff <= error);
        CHECK(coarse.surface.triangle_count() < last);
        last = coarse.surface.triangle_count();
    }
    const Decimated both = decimate(surface, {.triangles = last * 2, .max_error = 0.3});
    CHECK(both.surface.triangle_count() <= last * 2);
    CHECK(both.surface.triangle_count() + 2 > last * 2);
}

SCENARIO("Weights control where triangles are removed", "[meshing][decimate]") {
    const Surface sphere = icosphere(10.0, 4);
    const auto above = [](const Vec3& p) { return p.z() > 0.5; };
    const auto below = [](const Vec3& p) { return p.z() < -0.5; };
    GIVEN("weight 0 above and 1 below") {
        const auto weights =
            weights_by(sphere, [&](const Vec3& p) { return p.z() >= 0 ? 0.0 : 1.0; });
        const Surface coarse = decimated(sphere, 3200, weights);
        THEN("all above stays as it was, bit for bit") {
            CHECK(triangles_where(coarse, above) == triangles_where(sphere, above));
            for (const Vec3& p : sphere.points())
                if (above(p)) CHECK(std::ranges::count(coarse.points(), p) == 1);
            CHECK(triangles_where(coarse, below) < triangles_where(sphere, below) / 2);
        }
        THEN("it goes, too, when nothing else is left, and that is told") {
            const Decimated least = decimate(sphere, {.triangles = 500}, weights);
            CHECK(least.report.target_reached);
            CHECK(least.report.kept_vertices_lost > 0);
            CHECK(least.report.kept_vertices_lost <=
                  static_cast<std::size_t>(std::ranges::count(weights, 0.0)));
            CHECK(is_closed_manifold(least.surface));
        }
        THEN("a largest error does not touch it") {
            const Decimated error = decimate(sphere, {.max_error = 0.5}, weights);
            CHECK(triangles_where(error.surface, above) == triangles_where(sphere, above));
            CHECK(error.report.kept_vertices_lost == 0);
        }
    }
    GIVEN("weight 0 everywhere") {
        const std::vector<double> weights(sphere.vertex_count(), 0.0);
        const Decimated few = decimate(sphere, {.triangles = 100}, weights);
        std::size_t as_before = 0;
        for (const Vec3& p : few.surface.points())
            as_before += std::ranges::count(sphere.points(), p) > 0 ? 1 : 0;
        THEN("what is lost is told once for each vertex") {
            CHECK(few.report.kept_vertices_lost == sphere.vertex_count() - as_before);
        }
    }
    GIVEN("weight 0.1 above and 1 below") {
        const auto weights =
            weights_by(sphere, [&](const Vec3& p) { return p.z() >= 0 ? 0.1 : 1.0; });
        const Surface coarse = decimated(sphere, 1000, weights), plain = decimated(sphere, 1000);
        THEN("there are more triangles above, and the distance there is smaller") {
            CHECK(triangles_where(coarse, above) > 3 * triangles_where(coarse, below));
            const auto gained = compare_by_weight(coarse, sphere, weights);
            const auto without = compare_by_weight(plain, sphere, weights);
            CHECK(gained.outside.mean < 0.7 * without.outside.mean);
            CHECK(gained.inside.mean > without.inside.mean);
        }
    }
    GIVEN("the same weight everywhere") {
        const std::vector<double> weights(sphere.vertex_count(), 0.25);
        CHECK(decimated(sphere, 800, weights).points() == decimated(sphere, 800).points());
    }
}

SCENARIO("The same input gives the same bits; turned and scaled the same shape",
         "[meshing][decimate]") {
    const Surface tree = branching();
    const Surface coarse = decimated(tree, 600);
    CHECK(decimated(tree, 600).points() == coarse.points());
    const Eigen::Matrix3d rotation = skew_rotation();
    const Surface turned = mapped(tree, [&](const Vec3& p) -> Vec3 { return rotation * p; });
    const Surface in_metres =
        mapped(tree, [](const Vec3& p) -> Vec3 { return 1e-3 * p + Vec3(1, 2, 3); });
    const double distance = compare_with_reference(coarse, tree).mean_distance;
    CHECK(compare_with_reference(decimated(turned, 600), turned).mean_distance ==
          Approx(distance).epsilon(0.05));
    CHECK(1e3 * compare_with_reference(decimated(in_metres, 600), in_metres).mean_distance ==
          Approx(distance).epsilon(0.05));
}

SCENARIO("Walls that almost touch do not cross when decimated", "[meshing][decimate]") {
    const Surface shell = sphere_shell(10.0, 0.1, 5);
    const Decimated coarse = decimate(shell, {.triangles = shell.triangle_count() / 10});
    CHECK(coarse.report.crossings_left == 0);
    CHECK(self_intersections(coarse.surface).empty());
}

SCENARIO("If walls would cross, vertices are kept in further attempts", "[meshing][decimate]") {
    const Surface shell = sphere_shell(10.0, 0.03, 4);
    const DecimateParameters target{.triangles = shell.triangle_count() / 20};
    std::vector<double> fractions;
    std::size_t locked = 0;
    std::stop_source stop;
    THEN("the progress grows from one attempt to the next") {
        const Decimated coarse = decimate(
            shell, target, {},
            Progress([&](double done, std::string_view) { fractions.push_back(done); }, {}));
        CHECK(coarse.report.vertices_locked > 0);
        CHECK_FALSE(coarse.report.target_reached);
        CHECK(std::ranges::is_sorted(fractions));
    }
    THEN("a user can cancel in between") {
        const auto cancel = [&](double, std::string_view what) {
            if (what == "separating walls" && ++locked == 1) stop.request_stop();
        };
        CHECK_THROWS_AS(decimate(shell, target, {}, Progress(cancel, stop.get_token())), Cancelled);
        CHECK(locked == 1);
    }
}

SCENARIO("Real vessels stay sound when decimated", "[meshing][decimate]") {
    const auto name = GENERATE("vmtk_aorta_surface.stl", "vmtk_aorta_surface_open_ends.stl",
                               "vampy_aneurisk_C0015_artery.vtp", "vampy_left_atrium.vtp");
    const std::string path = shared_data(std::string("surfaces/") + name);
    if (path.empty()) return;
    const Surface vessel = read_surface(path).surface;
    const Surface coarse = decimated(vessel, vessel.triangle_count() / 4);
    CAPTURE(name);
    const Connectivity before = connectivity(*vessel.topology),
                       after = connectivity(*coarse.topology);
    CHECK(after.manifold);
    CHECK(after.genus == before.genus);
    CHECK(after.components == before.components);
    CHECK(after.boundary_loops == before.boundary_loops);
    CHECK(self_intersections(coarse).size() <= self_intersections(vessel).size());
    CHECK(volume(coarse) == Approx(volume(vessel)).epsilon(0.003));
    CHECK(measure(coarse).equiangle_skewness.mean < 0.5);
}

SCENARIO("A largest error holds on a surface full of slivers, too", "[meshing][decimate]") {
    const std::string path = shared_data("surfaces/vmtk_aorta_surface.stl");
    if (path.empty()) return;
    const Surface vessel = read_surface(path).surface;
    const Surface coarse = decimate(vessel, {.max_error = 0.1}).surface;
    CHECK(coarse.triangle_count() < vessel.triangle_count() / 5);
    CHECK(compare_with_reference(coarse, vessel).hausdorff <= 0.1);
    CHECK(self_intersections(coarse).empty());
}

SCENARIO("Decimation refuses what makes no sense", "[meshing][decimate]") {
    const Surface sphere = icosphere(1.0, 2);
    CHECK_THROWS_AS(decimate(Surface{}, {.triangles = 10}), InvalidInput);
    CHECK_THROWS_WITH(decimate(sphere, {}), Catch::Contains("number of triangles"));
    CHECK_THROWS_WITH(decimate(sphere, {.triangles = 0}), Catch::Contains("triangles = 0"));
    CHECK_THROWS_WITH(decimate(sphere, {.max_error = 0.0}), Catch::Contains("max_error"));
    CHECK_THROWS_WITH(decimate(sphere, {.max_error = std::numeric_limits<double>::quiet_NaN()}),
                      Catch::Contains("max_error"));
    const std::vector<double> few(3, 1.0);
    CHECK_THROWS_WITH(decimate(sphere, {.triangles = 10}, few), Catch::Contains("weights"));
    std::vector<double> odd(sphere.vertex_count(), 1.0);
    odd[5] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(decimate(sphere, {.triangles = 10}, odd), Catch::Contains("weight"));
    const Surface fan = make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                     {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    CHECK_THROWS_WITH(decimate(fan, {.triangles = 2}), Catch::Contains("repair"));
    Positions places = sphere.points();
    places[7].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(decimate(sphere.with_positions(places), {.triangles = 10}),
                      Catch::Contains("vertex 7"));
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(decimate(sphere, {.triangles = 10}, {}, Progress(nullptr, stop.get_token())),
                    Cancelled);
    CHECK(decimated(sphere, 1).triangle_count() == 4);
    const Surface point = sphere.with_positions(Positions(sphere.vertex_count(), Vec3(1, 2, 3)));
    const Surface still = decimated(point, 100);
    for (const Vec3& p : still.points()) CHECK(p == Vec3(1, 2, 3));
    CHECK_NOTHROW(decimate(point, {.max_error = 0.1}));
    CHECK(decimated(sphere, 1000).points() == sphere.points());
}
