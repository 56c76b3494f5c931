#include "geometry/vessel/repair/repair.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Without the triangles whose centre lies within `radius` of `centre`.
Surface punched(const Surface& surface, const Vec3& centre, double radius) {
    std::vector<bool> keep;
    for (const Triangle& t : surface.triangles()) {
        const auto& x = surface.points();
        keep.push_back(((x[t[0]] + x[t[1]] + x[t[2]]) / 3.0 - centre).norm() > radius);
    }
    return select_triangles(surface, keep);
}

/// A manifold, outward, free of self-intersections; and a second repair finds nothing.
void check_clean(const Surface& surface) {
    const SurfaceMeasures m = measure(surface);
    CHECK(m.connectivity.manifold);
    CHECK(m.connectivity.oriented);
    CHECK(m.connectivity.components == 1);
    CHECK(m.self_intersections == 0);
    CHECK(m.volume > 0.0);
    CHECK(m.edge_length.min > 0.9e-3 * m.edge_length.mean);
    const Repaired again = repair(surface);
    CHECK_FALSE(again.report.changed());
    CHECK(again.surface.points() == surface.points());
}

}  // namespace

SCENARIO("A clean surface is returned unchanged", "[geometry][repair]") {
    for (const Surface& surface :
         {icosphere(3.0, 3), open_tube(2.0, 20.0, 24, 30), closed_tube(2.0, 20.0, 24, 30)}) {
        const Repaired repaired = repair(surface);
        CHECK_FALSE(repaired.report.changed());
        CHECK(repaired.surface.topology == surface.topology);
        CHECK(repaired.surface.patches == surface.patches);
    }
}

SCENARIO("Loose, doubled and turned triangles are put together", "[geometry][repair]") {
    const Surface sphere = icosphere(3.0, 3);
    GIVEN("every triangle with its own three points, some turned, some twice, some a line") {
        Positions points;
        std::vector<Triangle> triangles;
        for (TriangleId t = 0; t < sphere.triangle_count(); ++t)
            for (int copy = 0; copy < (t % 10 == 0 ? 2 : 1); ++copy) {
                const auto first = static_cast<VertexId>(points.size());
                for (const VertexId v : sphere.triangles()[t]) points.push_back(sphere.points()[v]);
                triangles.push_back({first, first + 1 + t % 2, first + 2 - t % 2});
            }
        triangles.push_back({0, 1, 1});
        const Repaired repaired = repair(make_surface(points, triangles));
        check_clean(repaired.surface);
        CHECK(repaired.surface.vertex_count() == sphere.vertex_count());
        CHECK(repaired.surface.triangle_count() == sphere.triangle_count());
        CHECK(volume(repaired.surface) == Approx(volume(sphere)));
        CHECK(repaired.report.duplicate_triangles == (sphere.triangle_count() + 9) / 10);
        CHECK(repaired.report.degenerate_triangles == 1);
        CHECK(repaired.report.turned_triangles > 0);
    }
    GIVEN("a sphere that is inside out") {
        const Repaired repaired = repair(flipped(sphere));
        check_clean(repaired.surface);
        CHECK(repaired.report.turned_inside_out);
    }
    GIVEN("a stray piece beside it") {
        const Repaired repaired = repair(merged(icosphere(0.3, 1, Vec3(9, 0, 0)), sphere));
        check_clean(repaired.surface);
        CHECK(repaired.report.removed_components == 1);
        CHECK(volume(repaired.surface) == Approx(volume(sphere)));
        CHECK_FALSE(repaired.report.removed_vessel);
    }
    GIVEN("a piece of a vessel beside it, of few triangles") {
        const Surface piece = mapped(closed_tube(0.2, 3.0, 6, 4),
                                     [](const Vec3& p) { return Vec3(p.z(), 9.0 + p.y(), p.x()); });
        const Surface both = merged(merged(icosphere(0.6, 1, Vec3(9, 0, 0)), sphere), piece);
        const Repaired repaired = repair(both);
        CHECK(repaired.report.removed_components == 2);
        REQUIRE(repaired.report.removed_vessel);
        CHECK(repaired.report.removed_vessel->length == Approx(3.0).epsilon(0.05));
        CHECK(repaired.report.removed_vessel->diameter == Approx(0.4).epsilon(0.15));
        REQUIRE(repaired.report.keeping_it == 3);
        CHECK_FALSE(repair(both, {.keep_components = 3}).report.removed_vessel);
    }
}

SCENARIO("Of the two sides of a vessel's wall the lumen's is taken", "[geometry][repair]") {
    const Surface lumen = open_tube(2.0, 24.0, 32, 60), outer = open_tube(2.6, 24.0, 32, 60);
    for (const Surface& inner : {lumen, flipped(lumen)}) {
        const Repaired repaired = repair(merged(outer, inner));
        CHECK(repaired.report.removed_outer_wall);
        CHECK(repaired.report.removed_components == 1);
        CHECK_FALSE(repaired.report.removed_vessel);
        CHECK(area(repaired.surface) == Approx(area(lumen)));
    }
    const Surface closed = closed_tube(2.6, 24.0, 32, 60);
    const Surface within = mapped(closed_tube(2.0, 23.0, 32, 60),
                                  [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 0.5)); });
    CHECK(volume(repair(merged(closed, within)).surface) == Approx(volume(within)));
    AND_THEN("a small body within the lumen, or a vessel beside it, is no lumen") {
        CHECK_FALSE(
            repair(merged(closed, icosphere(0.8, 2, Vec3(0, 0, 12)))).report.removed_outer_wall);
        const Surface beside = mapped(lumen, [](const Vec3& p) { return Vec3(p + Vec3(6, 0, 0)); });
        CHECK_FALSE(repair(merged(outer, beside)).report.removed_outer_wall);
    }
}

SCENARIO("Stray holes are closed, vessel ends stay open", "[geometry][repair]") {
    const Surface tube = open_tube(2.0, 24.0, 32, 60);
    const Surface holed = punched(punched(tube, Vec3(2, 0, 12), 0.6), Vec3(0, -2, 5), 0.5);
    REQUIRE(holed.topology->boundary_loops().size() == 4);
    for (const bool turned : {false, true}) {
        CAPTURE(turned);
        const Surface given =
            turned ? mapped(holed, [](const Vec3& p) { return Vec3(0.1 * (skew_rotation() * p)); })
                   : holed;
        const double scale = turned ? 0.1 : 1.0;
        const Repaired repaired = repair(given);
        check_clean(repaired.surface);
        CHECK(repaired.report.closed_holes == 2);
        REQUIRE(repaired.report.openings.size() == 2);
        CHECK(repaired.report.openings[0].radius == Approx(2.0 * scale).epsilon(0.01));
        CHECK(volume(repaired.surface) ==
              Approx(volume(tube) * scale * scale * scale).epsilon(2e-3));
    }
    WHEN("a radius is given") {
        CHECK(repair(holed, {.close_holes_up_to = 10.0}).report.openings.empty());
        CHECK(repair(holed, {.close_holes_up_to = 0.0}).report.closed_holes == 0);
    }
}

SCENARIO("A vessel's end stays open though its rim is torn", "[geometry][repair]") {
    // Every second tooth of the rim is half a radius long.
    const Surface tube = mapped(open_tube(2.0, 24.0, 32, 120), [](const Vec3& p) -> Vec3 {
        const int tooth =
            static_cast<int>(std::lround(std::atan2(p.y(), p.x()) * 16.0 / std::numbers::pi));
        const double length = p.z() > 23.9 && tooth % 2 == 0 ? 1.0 : 0.0;
        return Vec3(p + Vec3(0.0, 0.0, length));
    });
    const Repaired repaired = repair(tube);
    CHECK(repaired.report.closed_holes == 0);
    CHECK(repaired.report.openings.size() == 2);
    WHEN("a slit is closed that is as long as the vessel is wide") {
        const Surface slit = mapped(tube, [](const Vec3& p) -> Vec3 {
            return Vec3(p.x(), p.z() > 12.0 ? 0.02 * p.y() : p.y(), p.z());
        });
        CHECK(repair(slit).report.closed_holes == 1);
    }
}

SCENARIO("A vessel torn into strips stays open, a branch torn off at its wall is named",
         "[geometry][repair]") {
    // Four strips, each five radii longer than the gaps between them.
    const Surface tube = open_tube(2.0, 24.0, 32, 120);
    const auto opened = [&](const std::function<bool(const Vec3&)>& gone) {
        std::vector<bool> keep;
        for (const Triangle& t : tube.triangles())
            keep.push_back(
                !gone((tube.points()[t[0]] + tube.points()[t[1]] + tube.points()[t[2]]) / 3.0));
        return repair(select_triangles(tube, keep)).report;
    };
    const RepairReport torn = opened([](const Vec3& p) {
        return p.z() > 14.0 && std::cos(4.0 * std::atan2(p.y(), p.x())) > 0.0;
    });
    CHECK(torn.openings.size() == 2);
    CHECK(torn.closed_ends.empty());
    const auto hole = [&](double radius) {
        return opened([&](const Vec3& p) { return (p - Vec3(2, 0, 12)).norm() < radius; });
    };
    REQUIRE(hole(0.7).closed_ends.size() == 1);
    CHECK(hole(0.7).closed_ends[0].in_wall);
    CHECK(hole(0.7).closed_ends[0].lumen_radius == Approx(2.0).epsilon(0.05));
    CHECK(hole(0.3).closed_holes == 1);
    CHECK(hole(0.3).closed_ends.empty());
}

SCENARIO("A plane's oblique cut beside something wide stays open", "[geometry][repair]") {
    // An ellipse of 1 : 2.2 in a bulge that is three times as wide.
    constexpr double kHeight = 9.7;
    const Surface flat = mapped(icosphere(10.0, 5), [&](const Vec3& p) -> Vec3 {
        return Vec3(2.2 * p.x(), p.y(), std::min(p.z(), kHeight));
    });
    std::vector<bool> keep;
    for (const Triangle& t : flat.triangles())
        keep.push_back(
            std::ranges::any_of(t, [&](VertexId v) { return flat.points()[v].z() < kHeight; }));
    const Repaired repaired = repair(select_triangles(flat, keep));
    CHECK(repaired.report.closed_holes == 0);
    CHECK(repaired.report.openings.size() == 1);
}

SCENARIO("Bodies that touch at a vertex or an edge are separated", "[geometry][repair]") {
    const Surface pair =
        merged(cube(1.0), mapped(cube(1.0), [](const Vec3& p) { return Vec3(p + Vec3(1, 1, 0)); }));
    const Repaired repaired = repair(pair);
    check_clean(repaired.surface);
    CHECK(repaired.report.non_manifold_edges == 1);
    CHECK(repaired.report.removed_components == 1);
    CHECK(volume(repaired.surface) == Approx(1.0));
    const Surface corner =
        merged(cube(1.0), mapped(cube(1.0), [](const Vec3& p) { return Vec3(p + Vec3(1, 1, 1)); }));
    CHECK(repair(corner).report.non_manifold_vertices == 1);
}

SCENARIO("A fold is smoothed away", "[geometry][repair]") {
    const Surface sphere = icosphere(5.0, 4);
    Positions points = sphere.points();
    points[200] += 0.9 * (points[sphere.topology->rings().row(200)[0]] - points[200]) +
                   2.0 * (points[sphere.topology->rings().row(200)[0]] - points[200]);
    const Surface folded = sphere.with_positions(points);
    REQUIRE(measure(folded).self_intersections > 0);
    const Repaired repaired = repair(folded);
    check_clean(repaired.surface);
    CHECK(repaired.report.self_intersections > 0);
    CHECK(compare_with_reference(repaired.surface, sphere).hausdorff < 0.3);
}

SCENARIO("Slivers are removed, and nothing else moves", "[geometry][repair]") {
    const Surface tube = closed_tube(2.0, 20.0, 24, 30);
    // Every tenth triangle of the wall is divided at a point almost on one of its sides.
    Positions points = tube.points();
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (TriangleId t = 0; t < tube.triangle_count(); ++t) {
        const auto [a, b, c] = tube.triangles()[t];
        const auto label = (*tube.patch_labels)[t];
        if (t % 10 == 0 && label == 0) {
            const auto m = static_cast<VertexId>(points.size());
            points.push_back(0.4999 * points[a] + 0.4999 * points[b] + 0.0002 * points[c]);
            triangles.insert(triangles.end(), {{a, b, m}, {b, c, m}, {c, a, m}});
            labels.insert(labels.end(), 3, label);
        } else {
            triangles.push_back({a, b, c});
            labels.push_back(label);
        }
    }
    const Repaired repaired = repair(make_surface(points, triangles, labels, tube.patches));
    check_clean(repaired.surface);
    CHECK(repaired.report.flipped_edges > 10);
    CHECK(compare_with_reference(repaired.surface, tube).hausdorff < 1e-3);
    CHECK(measure_patches(repaired.surface)[1].area == Approx(measure_patches(tube)[1].area));
}

SCENARIO("Patches and attributes survive a repair", "[geometry][repair]") {
    Surface tube = closed_tube(2.0, 20.0, 24, 30);
    std::vector<double> heights;
    for (const Vec3& p : tube.points()) heights.push_back(p.z());
    tube.attributes["height"] = std::make_shared<const std::vector<double>>(heights);
    const Surface holed = punched(tube, Vec3(2, 0, 10), 0.6);
    const Repaired repaired = repair(flipped(holed));
    check_clean(repaired.surface);
    CHECK(repaired.surface.patches == tube.patches);
    CHECK(measure_patches(repaired.surface)[2].area == Approx(measure_patches(tube)[2].area));
    const auto& carried = *repaired.surface.attributes.at("height");
    for (VertexId v = 0; v < repaired.surface.vertex_count(); ++v)
        CHECK(std::abs(carried[v] - repaired.surface.points()[v].z()) < 1.0);
}

SCENARIO("A surface that is not a body is rejected", "[geometry][repair]") {
    CHECK_THROWS_AS(repair(Surface{}), InvalidInput);
    Positions points = icosphere(1.0, 1).points();
    points[3].x() = std::nan("");
    CHECK_THROWS_WITH(repair(icosphere(1.0, 1).with_positions(points)),
                      Catch::Contains("vertex 3"));
    GIVEN("a Moebius strip") {
        Positions band;
        std::vector<Triangle> triangles;
        constexpr VertexId n = 40;
        for (VertexId i = 0; i < n; ++i)
            for (const double side : {-1.0, 1.0}) {
                const double a = 2.0 * std::numbers::pi * i / n;
                const double r = 5.0 + side * std::cos(0.5 * a);
                band.emplace_back(r * std::cos(a), r * std::sin(a), side * std::sin(0.5 * a));
            }
        for (VertexId i = 0; i < n; ++i) {
            const bool last = i + 1 == n;
            const VertexId a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
            triangles.insert(triangles.end(), {{a, b, c}, {b, d, c}});
        }
        CHECK_THROWS_WITH(repair(make_surface(band, triangles)), Catch::Contains("Moebius"));
    }
    GIVEN("two spheres that pass through each other, joined by a bridge of triangles") {
        const Surface both = merged(icosphere(1.0, 2), icosphere(1.0, 2, Vec3(1.5, 0.1, 0.2)));
        CHECK_THROWS_AS(repair(both, {.keep_components = 2}), AlgorithmFailure);
    }
}

SCENARIO("Every real surface can be repaired", "[geometry][repair]") {
    const std::string folder = shared_data("surfaces");
    if (folder.empty()) return;
    const std::map<std::string, std::size_t> ends = {
        {"gmsh_aorta2_open.stl", 5},           {"openlb_cerebral_aneurysm3d.stl", 0},
        {"jk_carotid_left_lumen_raw.stl", 3},  {"jk_carotid_left_lumen_clipped.stl", 3},
        {"vampy_left_atrium.vtp", 5},          {"vmtk_aorta_surface_open_ends.stl", 3},
        {"vampy_aneurisk_C0015_artery.vtp", 3}};
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        CAPTURE(name);
        const Repaired repaired = repair(read_surface(entry.path().string()).surface);
        check_clean(repaired.surface);
        if (ends.contains(name)) CHECK(repaired.report.openings.size() == ends.at(name));
    }
}

SCENARIO("Nasty meshes are repaired or refused, never half repaired", "[geometry][repair]") {
    for (const std::string name :
         {"assimp_sphere_with_hole.stl", "gc_hourglass_ico.obj", "gc_moebius.obj",
          "gc_triple_vierbein.obj", "igl_truck.obj", "manifold_box_not_manifold.obj",
          "manifold_openscad_nonmanifold_crash.obj", "manifold_self_intersectA.obj",
          "palabos_aneurysm_orientation.stl", "svmtk_degtri_sliding.off",
          "svmtk_mech_holes_shark.off", "svmtk_pig.off", "svmtk_sphere_r6_double.off",
          "trimesh_multibody.stl", "trimesh_nancolor.obj", "trimesh_negative_indices.obj",
          "trimesh_shared_edge.stl", "trimesh_soup.stl"}) {
        const std::string path = shared_data("nasty/" + name);
        if (path.empty()) return;
        CAPTURE(name);
        const Surface surface = read_surface(path).surface;
        try {
            check_clean(repair(surface).surface);
        } catch (const AlgorithmFailure& failure) {
            CHECK(std::string(failure.what()).size() > 40);
        }
    }
}
