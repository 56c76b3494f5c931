#include "meshing/remeshing/remesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/feature_regions.h"
#include "meshing/remeshing/remesher.h"
#include "meshing/remeshing/surface_walk.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

void check_quality(const RemeshReport& report) {
    CHECK(report.wall.equiangle_skewness.mean <= 0.12);
    CHECK(report.wall.equiangle_skewness.max <= 0.65);
    CHECK(report.wall.radius_ratio.mean >= 0.97);
    CHECK(report.wall.radius_ratio.min >= 0.35);
    CHECK(report.caps.equiangle_skewness.mean < 0.2);
}

/// Between a surface and what was made of it, at the vertices of both [mm].
double largest_distance(const Surface& source, const Surface& result) {
    double largest = 0.0;
    for (const auto& [from, to] : {std::pair{&source, &result}, {&result, &source}})
        for (const SurfacePoint& nearest : SurfaceDistance(*to).closest_points(from->points()))
            largest = std::max(largest, nearest.distance);
    return largest;
}

/// A ball of radius 5 mm, dented from above until the dent's tip is this far from the wall below.
Surface dented(double gap) {
    return mapped(icosphere(5.0, 5), [&](const Vec3& p) {
        const double off_axis = (p[0] * p[0] + p[1] * p[1]) / 20.0;
        if (p[2] < 0.0 || off_axis > 1.0) return p;
        const double depth = std::pow(1.0 - off_axis, 0.3);
        return Vec3(p[0], p[1], (1.0 - depth) * p[2] + depth * (gap - 5.0));
    });
}

void check_sound(const Surface& surface, bool closed) {
    const Connectivity parts = connectivity(*surface.topology);
    CHECK(parts.closed == closed);
    CHECK(parts.manifold);
    CHECK(parts.oriented);
    CHECK(self_intersections(surface).empty());
}

/// Largest ratio of the mean edge lengths of two triangles that share an edge.
double largest_gradation(const Surface& surface) {
    const auto triangles = surface.triangles();
    const CompressedRows& fans = surface.topology->triangles_at();
    const auto mean_edge = [&](TriangleId t) {
        const auto& [a, b, c] = triangles[t];
        const Positions& p = surface.points();
        return ((p[a] - p[b]).norm() + (p[b] - p[c]).norm() + (p[c] - p[a]).norm()) / 3.0;
    };
    double largest = 1.0;
    for (TriangleId t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
            for (const TriangleId s : fans.row(triangles[t][i])) {
                const auto& other = triangles[s];
                const VertexId next = triangles[t][(i + 1) % 3];
                if (s != t && std::count(other.begin(), other.end(), next) > 0)
                    largest = std::max(largest, mean_edge(s) / mean_edge(t));
            }
    return largest;
}

/// A tube that narrows to a third in its middle, closed by flat fans.
Surface narrowed_tube() {
    return mapped(closed_tube(3.0, 24.0, 48, 96), [](const Vec3& p) {
        const double factor = 1.0 - 2.0 / 3.0 * std::exp(-std::pow((p.z() - 12.0) / 3.0, 2));
        return Vec3(factor * p.x(), factor * p.y(), p.z());
    });
}

std::map<std::string, double> patch_areas(const Surface& surface) {
    std::map<std::string, double> areas;
    for (const PatchMeasures& patch : measure_patches(surface)) areas[patch.name] = patch.area;
    return areas;
}

}  // namespace

SCENARIO("A capped tube is remeshed with its rims, planes and patches kept", "[meshing][remesh]") {
    const Surface tube = closed_tube(2.0, 12.0, 40, 60);
    const auto mode = GENERATE(RemeshMode::Graded, RemeshMode::Uniform);
    const auto [remeshed, report] = remesh(tube, {.mode = mode, .edge = 0.6});
    check_sound(remeshed, true);
    check_quality(report);
    // Every rim vertex lies on its circle and every cap vertex in its plane.
    for (TriangleId t = 0; t < remeshed.triangle_count(); ++t)
        for (const VertexId v : remeshed.triangles()[t]) {
            const Vec3& p = remeshed.points()[v];
            const double plane = remeshed.patch_of(t).name == "inlet" ? 0.0 : 12.0;
            if (remeshed.patch_of(t).kind != PatchKind::Wall)
                CHECK(p.z() == Approx(plane).margin(1e-12));
            else if (p.z() < 1e-9 || p.z() > 12.0 - 1e-9)
                CHECK(std::hypot(p.x(), p.y()) == Approx(2.0).epsilon(1e-9));
        }
    const auto before = patch_areas(tube), after = patch_areas(remeshed);
    REQUIRE(after.size() == 3);
    for (const auto& [name, area] : before) CHECK(after.at(name) == Approx(area).epsilon(0.02));
    // Graded edges are shorter at the rims.
    const double share = mode == RemeshMode::Uniform ? 0.08 : 0.12;
    CHECK(mean_edge_length(remeshed) == Approx(0.6).epsilon(share));
    CHECK(volume(remeshed) == Approx(volume(tube)).epsilon(0.02));
}

SCENARIO("Edges follow the vessel's radius, and neighbours stay alike", "[meshing][remesh]") {
    const Surface tube = narrowed_tube();
    const auto [remeshed, report] = remesh(tube, {.edge = 0.8});
    check_sound(remeshed, true);
    check_quality(report);
    CHECK(largest_gradation(remeshed) <= 1.5);
    double narrow = 0.0, wide = 0.0, narrow_count = 0.0, wide_count = 0.0;
    for (const Triangle& t : remeshed.triangles()) {
        const double z = remeshed.points()[t[0]].z();
        const double edge = (remeshed.points()[t[0]] - remeshed.points()[t[1]]).norm();
        if (std::abs(z - 12.0) < 1.0) narrow += edge, narrow_count += 1.0;
        if (std::abs(z - 3.0) < 1.0) wide += edge, wide_count += 1.0;
    }
    CHECK(narrow / narrow_count < 0.55 * wide / wide_count);
}

SCENARIO("Closed and open surfaces without caps are remeshed", "[meshing][remesh]") {
    GIVEN("a sphere") {
        const auto [remeshed, report] = remesh(icosphere(5.0, 4), {.edge = 0.7});
        check_sound(remeshed, true);
        check_quality(report);
        CHECK(volume(remeshed) == Approx(volume(icosphere(5.0, 4))).epsilon(0.01));
    }
    GIVEN("an open tube") {
        const Surface tube = open_tube(2.0, 10.0, 40, 50);
        const auto [remeshed, report] = remesh(tube, {.edge = 0.5});
        check_sound(remeshed, false);
        check_quality(report);
        CHECK(remeshed.topology->boundary_loops().size() == 2);
        for (const auto& loop : remeshed.topology->boundary_loops())
            for (const VertexId v : loop) {
                const double z = remeshed.points()[v].z();
                CHECK(std::min(std::abs(z), std::abs(z - 10.0)) < 1e-12);
            }
    }
}

SCENARIO("Slivers and long fans do no harm", "[meshing][remesh]") {
    // 400 thin triangles around, 3 rows along: aspect ratios of 130, and fans as caps.
    const auto [remeshed, report] = remesh(closed_tube(2.0, 12.0, 400, 3), {.edge = 0.5});
    check_sound(remeshed, true);
    check_quality(report);
}

SCENARIO("A coarse source is not split into slivers of slivers", "[meshing][remesh]") {
    const Surface bar = mapped(icosphere(1.0, 0), [](const Vec3& p) {
        return Vec3(300.0 * p.x(), 10.0 * p.y(), 6.0 * p.z());
    });
    constexpr double kEdge = 2.0;
    Remesher remesher(bar, std::vector<double>(bar.vertex_count(), kEdge), bar);
    remesher.split_long_edges();
    const double wanted = area(bar) / (std::sqrt(3.0) / 4.0 * kEdge * kEdge);
    CHECK(static_cast<double>(remesher.mesh.triangle_count()) < 12.0 * wanted);
}

SCENARIO("A walk finds the closest place, and stays on its sheet", "[meshing][remesh]") {
    GIVEN("a sphere and a place near it") {
        const Surface sphere = icosphere(5.0, 4);
        const SurfaceWalk walk(sphere);
        const SurfaceDistance search(sphere);
        for (VertexId v = 0; v < sphere.vertex_count(); v += 97) {
            const Vec3 x = 1.02 * sphere.points()[v] + Vec3(0.1, -0.2, 0.15);
            const TriangleId from = sphere.topology->triangles_at().row(v)[0];
            const SurfaceWalk::Place place = walk.closest(x, from);
            CHECK(std::sqrt(place.squared) == Approx(search.closest_point(x).distance));
            CHECK((place.point - x).squaredNorm() == Approx(place.squared));
            CHECK(place.weights.sum() == Approx(1.0));
        }
    }
    GIVEN("a dent close to the wall, and a place below the wall") {
        const Surface body = dented(0.01);
        const SurfaceDistance search(body);
        const SurfacePoint below = search.closest_point(Vec3(0, 0, -5.1));
        const SurfaceWalk::Place place =
            SurfaceWalk(body).closest(Vec3(0.0, 0.0, -4.988), below.triangle);
        CHECK(place.point.z() < -4.995);
    }
}

SCENARIO("What is far from any change rests", "[meshing][remesh]") {
    const Surface tube = closed_tube(1.0, 20.0, 40, 200);
    std::vector<double> sizes(tube.vertex_count(), 0.3), finer = sizes;
    Remesher remesher(tube, sizes, tube);
    remesher.split_long_edges();
    remesher.collapse_short_edges();
    const Surface before = remesher.result();
    for (VertexId v = 0; v < finer.size(); ++v)
        if (tube.points()[v].z() > 15.0) finer[v] = 0.15;
    remesher.set_sizes(finer);
    remesher.split_long_edges();
    remesher.relax(Remesher::RelaxRule::Shape);
    const Surface after = remesher.result();
    const auto count_in = [](const Surface& surface, double low, double high) {
        return std::ranges::count_if(surface.points(),
                                     [&](const Vec3& p) { return low < p.z() && p.z() < high; });
    };
    CHECK(count_in(after, 0.0, 12.0) == count_in(before, 0.0, 12.0));
    CHECK(count_in(after, 16.0, 20.0) > 2 * count_in(before, 16.0, 20.0));
}

SCENARIO("A print has the triangles that its resolution needs", "[meshing][remesh]") {
    const Surface tube = mapped(closed_tube(3.0, 60.0, 200, 600), [](const Vec3& p) {
        const double factor = 1.0 - 0.7 * p.z() / 60.0;  // radius 3 to 0.9 mm
        return Vec3(factor * p.x(), factor * p.y() + 2.0 * std::sin(p.z() / 6.0), p.z());
    });
    const Remeshed usual = remesh(tube), print = remesh(tube, {.resolution = 0.1}),
                   fine = remesh(tube, {.resolution = 0.02});
    check_sound(print.surface, true);
    check_quality(print.report);
    CHECK(2 * print.report.triangles_after < usual.report.triangles_after);
    CHECK(print.report.triangles_after < fine.report.triangles_after);
    CHECK(largest_distance(tube, print.surface) < 0.1);
    CHECK(volume(print.surface) == Approx(volume(tube)).epsilon(0.01));
}

SCENARIO("A print's resolution is held where the wall is finer than its curvature tells",
         "[meshing][remesh]") {
    // Ridges across the tube, which are smoothed away where the wall's curvature is measured.
    const Surface ridged = mapped(fine_tube(3.0, 20.0, 240), [](const Vec3& p) {
        const double factor = 1.0 + 0.08 * std::exp(-std::pow(std::remainder(p.z(), 5.0) / 0.2, 2));
        return Vec3(factor * p.x(), factor * p.y(), p.z());
    });
    const Remeshed plain = remesh(ridged, {.resolution = 0.1}),
                   held = remesh(ridged, {.resolution = 0.1, .hold_resolution = true});
    CHECK(largest_distance(ridged, plain.surface) > 0.12);
    CHECK(largest_distance(ridged, held.surface) <= 0.1);
    CHECK_FALSE(held.report.beyond_resolution);
    check_sound(held.surface, true);
    CHECK(held.report.wall.radius_ratio.min >= 0.35);
    CHECK(held.report.triangles_after < 6 * plain.report.triangles_after);

    const Remeshed none = remesh(ridged, {.hold_resolution = true});
    CHECK(none.surface.points() == remesh(ridged).surface.points());
}

SCENARIO("A wall that crosses itself finer than its edges is not held there", "[meshing][remesh]") {
    // Across the tube runs a wave whose profile, a prolate trochoid, loops.
    const Surface folded = mapped(fine_tube(3.0, 8.0, 240), [](const Vec3& p) {
        constexpr double kLength = 0.8, kAmplitude = 0.2;  // more than length / 2 pi: it loops
        const double wave = 2.0 * std::numbers::pi * (p.z() - 4.0) / kLength,
                     amplitude = kAmplitude * std::exp(-std::pow((p.z() - 4.0) / 0.6, 8));
        const double factor = 1.0 + amplitude * std::cos(wave) / 3.0;
        return Vec3(factor * p.x(), factor * p.y(), p.z() - amplitude * std::sin(wave));
    });
    REQUIRE_FALSE(self_intersections(folded).empty());
    const Remeshed plain = remesh(folded, {.resolution = 0.1}),
                   held = remesh(folded, {.resolution = 0.1, .hold_resolution = true});
    check_sound(plain.surface, true);
    check_sound(held.surface, true);
    REQUIRE(held.report.beyond_resolution);
    CHECK(held.report.beyond_resolution->distance ==
          Approx(largest_distance(folded, held.surface)).epsilon(0.05));
}

SCENARIO("Remeshing reports its progress, which never goes back", "[meshing][remesh]") {
    std::vector<double> reports;
    const Progress progress([&](double fraction, auto) { reports.push_back(fraction); }, {});
    static_cast<void>(remesh(dented(0.01), {.edge = 0.5}, nullptr, progress));
    CHECK(reports.size() >= 15);
    CHECK(std::ranges::is_sorted(reports));
    CHECK(reports.back() <= 1.0);
}

SCENARIO("Remeshing keeps the edges around regions of a size", "[meshing][remesh]") {
    const Surface box = cube(10.0);
    const FeatureRegions sides = split_at_features(box, 60.0, 0.0);
    CHECK(sides.edges == 12);
    const Surface kept =
        sides.restored(remesh(sides.surface, {.mode = RemeshMode::Uniform, .edge = 1.0}).surface);
    CHECK(kept.patches == box.patches);
    CHECK(volume(kept) == Approx(volume(box)).epsilon(1e-9));
    check_sound(kept, true);
    CHECK(split_at_features(box, 95.0, 0.0).edges == 0);    // nothing bends so much
    CHECK(split_at_features(box, 60.0, 101.0).edges == 0);  // all sides are smaller
    CHECK_THROWS_AS(split_at_features(box, 0.0, 0.0), InvalidInput);
    THEN(
        "regions below the size join the neighbour of the longest border, the others keep their "
        "edges") {
        // Sides of 40, 80 and 200 mm^2: a smallest one has its longest edges along a largest one.
        const Surface slab =
            mapped(box, [](const Vec3& p) { return Vec3(0.4 * p.x(), p.y(), 2.0 * p.z()); });
        CHECK(split_at_features(slab, 60.0, 39.0).edges == 12);
        CHECK(split_at_features(slab, 60.0, 41.0).edges == 10);
        CHECK(split_at_features(slab, 60.0, 81.0).edges < 10);
    }
}

SCENARIO("Attributes are interpolated", "[meshing][remesh]") {
    Surface tube = closed_tube(2.0, 12.0, 40, 60);
    std::vector<double> heights;
    for (const Vec3& p : tube.points()) heights.push_back(p.z());
    tube.attributes["height"] = std::make_shared<const std::vector<double>>(heights);
    const Surface remeshed = remesh(tube, {.edge = 0.6}).surface;
    REQUIRE(remeshed.attributes.contains("height"));
    for (std::size_t v = 0; v < remeshed.vertex_count(); ++v)
        CHECK((*remeshed.attributes.at("height"))[v] ==
              Approx(remeshed.points()[v].z()).margin(1e-9));
}

SCENARIO("Remeshing is deterministic and independent of unit and direction", "[meshing][remesh]") {
    const Surface tube = narrowed_tube();
    const Remeshed first = remesh(tube, {.edge = 0.8});
    THEN("one thread gives the same bits") {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const Remeshed again = remesh(tube, {.edge = 0.8});
        CHECK(again.surface.points() == first.surface.points());
        CHECK(std::ranges::equal(again.surface.triangles(), first.surface.triangles()));
    }
    THEN("a turned tube of a thousandth of the size is remeshed alike") {
        const Eigen::Matrix3d turn = skew_rotation();
        const Surface other =
            mapped(tube, [&](const Vec3& p) { return Vec3(1e-3 * (turn * p) + Vec3(1, 2, 3)); });
        const Remeshed turned = remesh(other, {.edge = 0.8e-3});
        check_quality(turned.report);
        CHECK(static_cast<double>(turned.surface.triangle_count()) ==
              Approx(static_cast<double>(first.surface.triangle_count())).epsilon(0.1));
    }
}

SCENARIO("Walls that almost touch are separated where no edge is short enough",
         "[meshing][remesh]") {
    std::size_t parted = 0;
    for (const double gap : {2e-5, 1e-4, 2e-4, 5e-4})
        for (const double edge : {0.35, 0.45, 0.5, 0.6}) {
            CAPTURE(gap, edge);
            const Surface body = dented(gap);
            REQUIRE(self_intersections(body).empty());
            StopAt never(2.0);
            const Remeshed made = remesh(body, {.mode = RemeshMode::Uniform, .edge = edge}, nullptr,
                                         never.progress());
            check_sound(made.surface, true);
            CHECK(connected_components(*made.surface.topology).count() == 1);
            if (made.report.crossings_parted == 0) continue;
            parted += made.report.crossings_parted;
            CHECK(never.whats().contains("separating walls that cross"));
            CHECK(made.report.wall.equiangle_skewness.max <= 0.65);
            CHECK(made.report.wall.radius_ratio.min >= 0.35);
        }
    CHECK(parted > 0);
}

SCENARIO("An edge that makes too many triangles, or loses the vessel, is refused",
         "[meshing][remesh]") {
    const Surface tube = closed_tube(0.5, 20.0, 24, 60);
    const auto mode = GENERATE(RemeshMode::Graded, RemeshMode::Uniform);
    const auto refusal = [&](double edge) -> std::string {
        try {
            static_cast<void>(remesh(tube, {.mode = mode, .edge = edge}));
        } catch (const AlgorithmFailure& error) {
            return error.what();
        }
        return "";
    };
    CHECK_THAT(refusal(0.001), Catch::Contains("million triangles") && Catch::Contains("edge="));
    CHECK_THAT(refusal(3.0), Catch::Contains("too coarse") && Catch::Contains("edge=0.14"));
    CHECK(refusal(0.2).empty());
    for (const double edge : {21.0, 1e6, 1e308})  // micrometres
        CHECK_THAT(refusal(edge),
                   Catch::Contains("edge = ") && Catch::Contains("give at most 20 mm"));
    for (const double edge : {1e-308, 1e-6})
        CHECK_THAT(refusal(edge), Catch::Contains("a millionth") && Catch::Contains("edge=0.14"));
}

SCENARIO("Limits of edges out of proportion to the model are refused", "[meshing][remesh]") {
    const Surface tube = closed_tube(0.5, 20.0, 24, 60);
    CHECK_THROWS_WITH(remesh(tube, {.edge = 1e6, .min_edge = 1e6}),
                      Catch::Contains("edge = 1e+06"));
    CHECK_THROWS_WITH(remesh(tube, {.min_edge = 1e6, .max_edge = 1e6}),
                      Catch::Contains("min_edge = 1e+06"));
    CHECK_THROWS_WITH(remesh(tube, {.min_edge = 1e-308, .max_edge = 1e-308}),
                      Catch::Contains("min_edge = 1e-308"));
    CHECK_NOTHROW(remesh(tube, {.edge = 0.2, .max_edge = 1e308}));  // no limit
}

SCENARIO("Bad parameters and bad surfaces are refused", "[meshing][remesh]") {
    const Surface sphere = icosphere(5.0, 2);
    CHECK_THROWS_WITH(remesh(sphere, {.edge = -1.0}), Catch::Contains("edge"));
    CHECK_THROWS_WITH(remesh(sphere, {.edge = 1.0, .min_edge = 2.0, .max_edge = 1.0}),
                      Catch::Contains("max_edge"));
    CHECK_THROWS_WITH(remesh(sphere, {.gradation = 0.9}), Catch::Contains("gradation"));
    const Surface fin =
        make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)},
                     {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    CHECK_THROWS_AS(remesh(fin, {.edge = 0.5}), InvalidInput);
}
