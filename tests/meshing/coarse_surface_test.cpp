#include "meshing/remeshing/coarse_surface.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A coarse surface has the shape with fewer triangles", "[meshing][coarse]") {
    const Surface ball = icosphere(10.0, 6, Vec3(300, -20, 5));  // 40,962 vertices
    const Surface coarse = coarse_surface(ball, 32);
    CHECK(coarse.triangle_count() < ball.triangle_count() / 4);
    CHECK(area(coarse) == Approx(area(ball)).epsilon(0.1));
    for (const Vec3& point : coarse.points())
        REQUIRE((point - Vec3(300, -20, 5)).norm() == Approx(10.0).margin(0.3));
    WHEN("the grid is finer") {
        THEN("more is left") {
            CHECK(coarse_surface(ball, 64).triangle_count() > 2 * coarse.triangle_count());
        }
    }
    WHEN("the surface is small") {
        const Surface small = icosphere(10.0, 2);
        THEN("it is the same") {
            CHECK(coarse_surface(small, 4).topology == small.topology);
        }
    }
}

SCENARIO("A coarse surface keeps its patches", "[meshing][coarse]") {
    const Surface ball = icosphere(10.0, 6);
    PatchLabels labels(ball.triangle_count(), 0);
    for (TriangleId t = 0; t < ball.triangle_count(); ++t)
        if (ball.points()[ball.triangles()[t][0]].z() > 0) labels[t] = 1;
    const Surface split =
        ball.with_patches(labels, {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}});
    const Surface coarse = coarse_surface(split, 40);
    for (TriangleId t = 0; t < coarse.triangle_count(); ++t) {
        const double z = coarse.points()[coarse.triangles()[t][0]].z();
        if (z > 1.0) REQUIRE((*coarse.patch_labels)[t] == 1);
        if (z < -1.0) REQUIRE((*coarse.patch_labels)[t] == 0);
    }
}
