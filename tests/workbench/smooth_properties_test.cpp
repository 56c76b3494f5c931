// The properties of the thesis's Sec. 7.1, through the operation that users call.

#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/operation.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const std::vector<std::string> kFilters = {
    "laplace", "laplace-hc", "taubin", "mean-curvature-flow", "anisotropic", "curvature-triggered"};

/// Arguments that make a filter do something on a shape without sharp edges, too.
Arguments filter_arguments(const std::string& filter) {
    Arguments arguments = {{"filter", filter}};
    if (filter == "curvature-triggered") arguments.set("curvature", 1e-3);
    return arguments;
}

Arguments with(Arguments arguments, const Arguments& more) {
    for (const auto& [name, value] : more.values()) arguments.set(name, value);
    return arguments;
}

/// A ring around z whose section is a flight of stairs: level treads, upright risers, and a vertex
/// nowhere but on the edges between them.
Surface terraced_ring(int around) {
    const std::vector<std::pair<double, double>> section = {{8, 0},  {11, 0}, {11, 1}, {10, 1},
                                                            {10, 2}, {9, 2},  {9, 3},  {8, 3}};
    const auto count = static_cast<VertexId>(section.size());
    Positions points;
    std::vector<Triangle> triangles;
    for (int i = 0; i < around; ++i)
        for (const auto& [r, z] : section) {
            const double angle = 2.0 * M_PI * i / around;
            points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
        }
    const auto total = static_cast<VertexId>(points.size());
    for (VertexId i = 0; i < total; i += count)
        for (VertexId k = 0; k < count; ++k) {
            const VertexId next = (k + 1) % count, ahead = (i + count) % total;
            triangles.push_back({i + k, ahead + k, ahead + next});
            triangles.push_back({i + k, ahead + next, i + next});
        }
    return make_surface(std::move(points), std::move(triangles));
}

/// A tube with a wavy wall and flat ends.
Surface wavy_tube(bool patches) {
    const Surface tube = mapped(fine_tube(3.0, 12.0, 48), [](const Vec3& p) {
        const double r = p.head<2>().norm(), end = std::min(p.z(), 12.0 - p.z());
        const double wave =
            r > 2.9 && end > 0.0 ? 0.03 * std::sin(9.0 * p.z() + 40.0 * p.x()) : 0.0;
        return Vec3(p.x() * (1.0 + wave), p.y() * (1.0 + wave), p.z());
    });
    if (patches) return tube;
    return make_surface(tube.points(), {tube.triangles().begin(), tube.triangles().end()});
}

/// 1 for the vertices of every triangle that is not wall: caps with their rims.
std::vector<bool> of_patches(const Surface& surface) {
    std::vector<bool> chosen(surface.vertex_count(), false);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) chosen[v] = true;
    return chosen;
}

/// Arguments that can be combined with caps=keep.
std::vector<Arguments> contexts() {
    return {{},
            {{"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}, {"beta_min", 0.4}},
            {{"distance", std::string("exponential")}, {"omega", 0.5}},
            {{"painted", std::string("mine")}, {"distance", std::string("linear")}},
            {{"constraint", std::string("voxel")}, {"cell", Vec3(0.1, 0.1, 0.1)}},
            {{"constraint", std::string("diamond")}, {"cell", Vec3(0.1, 0.1, 0.1)}},
            {{"iterations", std::int64_t{60}}}};
}

Scene with_context(const Surface& surface) {
    Scene scene;
    scene.surface = surface;
    scene.surface->attributes["mine"] =
        std::make_shared<std::vector<double>>(surface.vertex_count(), 0.8);
    scene.neighbours["beside"] = icosphere(1.0, 2, Vec3(5, 0, 6));
    return scene;
}

/// Chosen vertices stay bit for bit, and the others move.
void check_kept(const Surface& surface, const std::vector<bool>& chosen, const std::string& what) {
    const Scene scene = with_context(surface);
    for (const std::string& filter : kFilters)
        for (const Arguments& context : contexts()) {
            const Arguments arguments = with(filter_arguments(filter), context);
            const Surface after = *run("smooth", scene, arguments).scene.surface;
            std::size_t moved = 0, strayed = 0;
            for (std::size_t v = 0; v < chosen.size(); ++v) {
                const bool went = after.points()[v] != surface.points()[v];
                (chosen[v] ? strayed : moved) += went ? 1 : 0;
            }
            INFO(what << ", " << filter
                      << (context.values().empty() ? std::string()
                                                   : ", " + context.values().begin()->first));
            REQUIRE(strayed == 0);
            REQUIRE(moved > 200);
        }
}

}  // namespace

SCENARIO("Without staircases, and beta_min 0, nothing moves", "[workbench][smooth]") {
    const Eigen::Matrix3d turn = skew_rotation();
    const Surface tube =
        mapped(fine_tube(3.0, 12.0, 48), [&](const Vec3& p) { return Vec3(turn * p); });
    for (const Surface& surface : {icosphere(5.0, 4), tube})
        for (const std::string& filter : kFilters) {
            CAPTURE(filter);
            const Outcome outcome =
                run("smooth", surface,
                    with(filter_arguments(filter),
                         {{"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}, {"beta_min", 0.0}}));
            CHECK((outcome.scene.surface->points() == surface.points()));
            CHECK(outcome.report->at("staircase_vertices") == 0);
            CHECK(outcome.report->at("mean_weight") == 0.0);
            const Outcome uniform = run("smooth", surface, filter_arguments(filter));
            CHECK(moved_vertices(surface, *uniform.scene.surface) > 500);
        }
}

SCENARIO("With staircases everywhere, the result is uniform smoothing", "[workbench][smooth]") {
    const Surface ring = terraced_ring(90);
    REQUIRE(is_closed_manifold(ring));
    REQUIRE(enclosed_volume(ring) > 0.0);
    for (const std::string& filter : kFilters)
        for (const double beta_min : {0.0, 0.3}) {
            CAPTURE(filter, beta_min);
            Arguments uniform = filter_arguments(filter);
            uniform.set("find_caps", false);
            const Outcome aware = run(
                "smooth", ring,
                with(uniform,
                     {{"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}, {"beta_min", beta_min}}));
            CHECK(aware.report->at("staircase_vertices") == ring.vertex_count());
            CHECK(aware.report->at("mean_weight") == 1.0);
            const Outcome plain = run("smooth", ring, uniform);
            CHECK((aware.scene.surface->points() == plain.scene.surface->points()));
            CHECK(moved_vertices(ring, *plain.scene.surface) >=
                  ring.vertex_count() / 2);  // some keep edges
        }
}

SCENARIO("caps=keep leaves every cap vertex and rim bit for bit", "[workbench][smooth]") {
    GIVEN("the patches of a surface") {
        const Surface tube = wavy_tube(true);
        check_kept(tube, of_patches(tube), "patches");
    }
    GIVEN("flat ends that nobody named, however they lie in space") {
        const Surface tube = wavy_tube(false);
        std::vector<bool> ends;
        for (const Vec3& p : tube.points()) ends.push_back(p.z() == 0.0 || p.z() == 12.0);
        check_kept(tube, ends, "found ends");
        const Eigen::Matrix3d turn = skew_rotation();
        check_kept(mapped(tube, [&](const Vec3& p) { return Vec3(turn * p); }), ends,
                   "found ends, turned");
    }
    GIVEN("what the step openings left: clipped and extruded ends") {
        const Surface open = mapped(open_tube(2.0, 16.0, 24, 40), [](const Vec3& p) {
            return Vec3(p.x() * (1.0 + 0.02 * std::sin(8.0 * p.z())), p.y(), p.z());
        });
        const Surface clipped = *run("clip-opening", open, {}).scene.surface;
        check_kept(clipped, of_patches(clipped), "clipped");
        const Surface extruded = *run("extrude-opening", clipped, {}).scene.surface;
        check_kept(extruded, of_patches(extruded), "extruded");
    }
}

SCENARIO("caps=smooth and caps=round move caps", "[workbench][smooth]") {
    const Surface tube = wavy_tube(true);
    const std::vector<bool> caps = of_patches(tube);
    const auto mode = GENERATE(as<std::string>(), "smooth", "round");
    const Surface after =
        *run("smooth", tube, {{"filter", std::string("laplace")}, {"caps", mode}}).scene.surface;
    std::size_t moved = 0;
    for (std::size_t v = 0; v < caps.size(); ++v)
        moved += caps[v] && after.points()[v] != tube.points()[v] ? 1 : 0;
    CHECK(moved > 50);
}

SCENARIO("smooth has the same bits on any number of threads", "[workbench][smooth]") {
    const Scene scene = with_context(wavy_tube(true));
    for (const std::string& filter : kFilters)
        for (const Arguments& context : contexts()) {
            CAPTURE(filter);
            const Arguments arguments = with(filter_arguments(filter), context);
            const Outcome many = run("smooth", scene, arguments);
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            const Outcome single = run("smooth", scene, arguments);
            REQUIRE((single.scene.surface->points() == many.scene.surface->points()));
            REQUIRE(*single.report == *many.report);
        }
}
