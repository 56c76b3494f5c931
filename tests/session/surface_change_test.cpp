#include "workbench/session/surface_change.h"

#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

}  // namespace

SCENARIO("The figures of a change", "[session][surface_change]") {
    const Scene sphere = scene_of(test::icosphere(10.0, 3));
    GIVEN("the same connectivity") {
        const Scene larger =
            scene_of(test::mapped(*sphere.surface, [](const Vec3& p) { return Vec3(1.01 * p); }));
        const SurfaceChange change = surface_change(sphere, larger);
        CHECK(change.moved_vertices == sphere.surface->vertex_count());
        CHECK(change.mean_deviation.value() == Approx(0.1));
        CHECK(change.largest_deviation.value() == Approx(0.1));
        CHECK(change.volume_after.value() / change.volume_before.value() ==
              Approx(1.01 * 1.01 * 1.01));
    }
    GIVEN("another connectivity") {
        const Scene other = scene_of(test::icosphere(10.1, 4));
        const SurfaceChange change = surface_change(sphere, other);
        CHECK(change.moved_vertices == 0);
        CHECK(change.triangles_after == 4 * change.triangles_before);
        CHECK(change.mean_deviation.value() == Approx(0.12).margin(0.03));
    }
    GIVEN("a part that is gone: the deviation is seen from the old surface") {
        Surface left = test::open_tube(2.0, 10.0, 24, 20);
        std::vector<Triangle> half(left.triangles().begin(),
                                   left.triangles().begin() + left.triangle_count() / 2);
        Positions points(left.points().begin(), left.points().begin() + 24 * 11);
        const SurfaceChange clean =
            surface_change(scene_of(left), scene_of(make_surface(points, half)));
        CHECK(clean.largest_deviation.value() == Approx(5.0));
        CHECK(clean.mean_deviation.value() > 0.5);
    }
    GIVEN("triangles that run either way, which enclose no volume") {
        std::vector<Triangle> turned(sphere.surface->triangles().begin(),
                                     sphere.surface->triangles().end());
        for (std::size_t t = 0; t < turned.size(); t += 3) std::swap(turned[t][0], turned[t][1]);
        const Scene mixed = scene_of(make_surface(Positions(sphere.surface->points()), turned));
        const SurfaceChange change = surface_change(mixed, sphere);
        CHECK_FALSE(change.volume_before);
        CHECK(change.volume_after.value() == Approx(volume(*sphere.surface)));
        CHECK_FALSE(volume_change(change));
    }
    GIVEN("nothing before or nothing after") {
        const SurfaceChange made = surface_change({}, sphere);
        CHECK_FALSE(made.volume_before);
        CHECK(made.volume_after.value() ==
              Approx(4.0 / 3.0 * std::numbers::pi * 1000.0).epsilon(0.02));
        CHECK_FALSE(made.largest_deviation);
        CHECK(surface_change(sphere, {}).triangles_after == 0);
        CHECK(surface_change(sphere, sphere).largest_deviation.value() == 0.0);
    }
}

SCENARIO("Changed vertices are those that differ", "[session][surface_change]") {
    const Surface before = test::icosphere(5.0, 2);
    CHECK(changed_vertices(before, before).empty());
    Positions points = before.points();
    points[3].x() += 0.1;
    points[17].z() -= 0.1;
    const Surface moved = before.with_positions(points);
    CHECK(changed_vertices(before, moved) == std::vector<VertexId>{3, 17});
    Surface painted = before;
    std::vector<double> weights(before.vertex_count(), 0.0);
    weights[5] = 1.0;
    painted.attributes["plaque"] = std::make_shared<const std::vector<double>>(weights);
    CHECK(changed_vertices(before, painted) == std::vector<VertexId>{5});
}
