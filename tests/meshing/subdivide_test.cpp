#include "meshing/remeshing/subdivide.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("Subdivision splits each triangle into four and smooths the surface",
         "[meshing][subdivide]") {
    const Surface coarse = icosphere(10.0, 1);
    const Surface fine = subdivide(coarse, 2);
    CHECK(fine.triangle_count() == 16 * coarse.triangle_count());
    CHECK(connectivity(*fine.topology).closed);
    CHECK(connectivity(*fine.topology).manifold);
    CHECK(volume(fine) > 0.8 * volume(coarse));
    const auto bends = [](const Surface& s) { return measure(s).normal_curvature_deg; };
    CHECK(bends(fine) < 0.3 * bends(coarse));
}

SCENARIO("Subdivision keeps patches, flat caps and attributes", "[meshing][subdivide]") {
    Surface tube = closed_tube(2.0, 10.0, 24, 12);
    std::vector<double> heights;
    for (const Vec3& p : tube.points()) heights.push_back(p.z());
    tube.attributes["height"] = std::make_shared<const std::vector<double>>(heights);
    const Surface fine = subdivide(tube, 1);
    for (const PatchMeasures& patch : measure_patches(fine))
        if (patch.kind != PatchKind::Wall) CHECK(patch.flatness < 1e-12);
    CHECK(fine.patches == tube.patches);
    CHECK(connectivity(*fine.topology).manifold);
    for (VertexId v = 0; v < fine.vertex_count(); ++v)
        CHECK((*fine.attributes.at("height"))[v] == Approx(fine.points()[v].z()).margin(0.2));
}

SCENARIO("Open boundaries stay in their plane when subdivided", "[meshing][subdivide]") {
    const Surface fine = subdivide(open_tube(2.0, 10.0, 16, 8), 2);
    REQUIRE(fine.topology->boundary_loops().size() == 2);
    for (const auto& loop : fine.topology->boundary_loops()) {
        CHECK(loop.size() == 64);
        for (const VertexId v : loop)
            CHECK(fine.points()[v].z() == Approx(fine.points()[loop[0]].z()).margin(1e-12));
    }
}

SCENARIO("Too many iterations are refused", "[meshing][subdivide]") {
    CHECK_THROWS_WITH(subdivide(cube(1.0), 0), Catch::Contains("iterations"));
    CHECK_THROWS_AS(subdivide(icosphere(1.0, 6), 6), InvalidInput);
}

SCENARIO("Subdivision is cancelled inside its last pass", "[meshing][subdivide][cancel]") {
    for (const double fraction : {0.0, 0.4, 0.6}) {
        StopAt stop(fraction);
        CHECK_THROWS_AS(subdivide(icosphere(10.0, 3), 1, stop.progress()), Cancelled);
    }
}
