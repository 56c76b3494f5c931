#include "meshing/remeshing/sizing_field.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "meshing/remeshing/local_radius.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

SizingParameters usual(double edge) {
    return {.edge = edge, .min_edge = 0.1 * edge, .max_edge = 2.0 * edge};
}

/// A tube of radius 2 along z with a round sac of radius 5 in its middle.
Surface tube_with_sac() {
    return mapped(closed_tube(2.0, 40.0, 48, 200), [](const Vec3& p) {
        const double h = p.z() - 20.0;
        const double sac = std::abs(h) < 5.0 ? std::sqrt(25.0 - h * h) : 0.0;
        const double factor = std::max(2.0, sac) / 2.0;
        return Vec3(factor * p.x(), factor * p.y(), p.z());
    });
}

}  // namespace

SCENARIO("Rays across the lumen measure a tube's and a sphere's radius", "[meshing][sizing]") {
    const Surface tube = closed_tube(2.0, 20.0, 48, 60);
    CHECK(usual_radius(tube, local_radii(tube, nullptr)) == Approx(2.0).epsilon(0.03));
    const Surface sphere = icosphere(5.0, 4);
    CHECK(usual_radius(sphere, local_radii(sphere, nullptr)) == Approx(5.0).epsilon(0.15));
}

SCENARIO("A sac is not meshed coarser than its parent vessel", "[meshing][sizing]") {
    const Surface vessel = tube_with_sac();
    GIVEN("rays") {
        for (const double radius : local_radii(vessel, nullptr)) CHECK(radius < 2.1);
    }
    GIVEN("a centerline that claims the sac's radius") {
        CenterlineGraph lines;
        lines.branches.push_back({.start_node = 0, .end_node = 1, .points = {}, .radii = {}});
        for (int i = 0; i <= 80; ++i) {
            const double h = 0.5 * i - 20.0;
            lines.branches[0].points.emplace_back(0, 0, 0.5 * i);
            lines.branches[0].radii.push_back(
                std::max(2.0, std::abs(h) < 5.0 ? std::sqrt(25.0 - h * h) : 0.0));
        }
        lines.nodes = {{Vec3(0, 0, 0), 2.0, {0}}, {Vec3(0, 0, 40), 2.0, {0}}};
        for (const double radius : local_radii(vessel, &lines)) CHECK(radius < 2.6);
    }
}

SCENARIO("Sizes grow no faster than the gradation allows", "[meshing][sizing]") {
    const Surface vessel = tube_with_sac();
    const auto sizes = sizing_field(vessel, local_radii(vessel, nullptr), usual(0.6));
    const CompressedRows& rings = vessel.topology->rings();
    for (VertexId v = 0; v < sizes.size(); ++v)
        for (const VertexId u : rings.row(v))
            CHECK(sizes[u] <= sizes[v] +
                                  slope_of(1.5) * (vessel.points()[u] - vessel.points()[v]).norm() +
                                  1e-12);
}

SCENARIO("A narrow gap to another wall makes small edges", "[meshing][sizing]") {
    const double gap = 0.3;
    Surface first = open_tube(2.0, 10.0, 64, 40);
    Positions points = first.points();
    std::vector<Triangle> triangles(first.triangles().begin(), first.triangles().end());
    const auto offset = static_cast<VertexId>(points.size());
    for (const Vec3& p : first.points()) points.push_back(p + Vec3(4.0 + gap, 0, 0));
    for (const auto& [a, b, c] : first.triangles())
        triangles.push_back({a + offset, b + offset, c + offset});
    const Surface pair = make_surface(std::move(points), std::move(triangles));
    const auto sizes = sizing_field(pair, local_radii(pair, nullptr), usual(0.8));
    double at_gap = 1e9, away = 1e9;
    for (VertexId v = 0; v < offset; ++v) {
        const Vec3& p = pair.points()[v];
        if (p.x() > 1.999) at_gap = std::min(at_gap, sizes[v]);
        if (p.x() < -1.9) away = std::min(away, sizes[v]);
    }
    CHECK(at_gap <= 1.01 * gap);
    CHECK(away > 2.0 * gap);
}

SCENARIO("Impossible sizes are refused by name", "[meshing][sizing]") {
    const Surface tube = closed_tube(2.0, 10.0, 16, 8);
    const auto radii = local_radii(tube, nullptr);
    CHECK_THROWS_WITH(sizing_field(tube, radii, {.edge = 0.0, .min_edge = 0.1, .max_edge = 1.0}),
                      Catch::Contains("edge"));
    CHECK_THROWS_WITH(sizing_field(tube, radii, {.edge = 0.5, .min_edge = 0.6, .max_edge = 0.4}),
                      Catch::Contains("max_edge"));
    CHECK_THROWS_WITH(
        sizing_field(tube, radii, {.edge = 0.5, .min_edge = 0.1, .max_edge = 1, .gradation = 1}),
        Catch::Contains("gradation"));
}
