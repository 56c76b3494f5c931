#include "gpu/render/drawing_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Vec3 normal_of(const DrawnVertex& vertex) {
    return Vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / 32767.0;
}

bool same(const DrawnVertex& a, const DrawnVertex& b) {
    return a.position == b.position && a.normal == b.normal && a.tag == b.tag;
}

}  // namespace

SCENARIO("Drawn triangles are the surface's, with corners of different colours",
         "[gpu][render][arrays]") {
    const Surface surface = GENERATE(icosphere(5.0, 4, Vec3(100, 50, -20)),
                                     closed_tube(2.0, 20.0, 24, 20), open_tube(2.0, 9.0, 17, 8));
    const DrawingArrays drawing = prepare_drawing(surface);
    REQUIRE(drawing.layout->triangles.size() == surface.triangle_count());
    REQUIRE(drawing.vertices.size() == surface.vertex_count() + drawing.layout->extras.size());
    CHECK(std::ranges::is_sorted(drawing.layout->extras));
    bool corners_match = true, patches_match = true, colours_differ = true;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        unsigned colours = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t drawn = drawing.layout->triangles[t][k];
            const unsigned tag = drawing.vertices[drawn].tag;
            corners_match =
                corners_match && original_of(drawing, drawn) == surface.triangles()[t][k];
            patches_match = patches_match && tag / 4 == (*surface.patch_labels)[t];
            colours |= 1U << tag % 4;
        }
        colours_differ = colours_differ && std::popcount(colours) == 3;
    }
    CHECK(corners_match);
    CHECK(patches_match);
    CHECK(colours_differ);
    CHECK(drawing.layout->extras.size() < surface.vertex_count() / 2);
}

SCENARIO("Normals are smooth within a patch and sharp at rims", "[gpu][render][arrays]") {
    const DrawingArrays sphere = prepare_drawing(icosphere(5.0, 4, Vec3(100, 50, -20)));
    double worst = 1.0;
    for (const DrawnVertex& vertex : sphere.vertices) {
        const Vec3 radial(vertex.position[0], vertex.position[1], vertex.position[2]);
        worst = std::min(worst, normal_of(vertex).dot(radial.normalized()));
    }
    CHECK(worst > 0.999);
    CHECK(sphere.bounds.radius == Approx(5.0));
    const DrawingArrays tube = prepare_drawing(closed_tube(2.0, 20.0, 24, 20));
    for (const DrawnVertex& vertex : tube.vertices)
        CHECK(std::abs(normal_of(vertex).z()) == Approx(vertex.tag < 4 ? 0.0 : 1.0).margin(1e-3));
}

SCENARIO("Moving a few vertices equals drawing the moved surface", "[gpu][render][arrays]") {
    const Surface surface = closed_tube(2.0, 20.0, 24, 20);
    DrawingArrays drawing = prepare_drawing(surface);
    Positions points = surface.points();
    std::vector<VertexId> moved;
    for (VertexId v = 0; v < points.size(); ++v)
        if ((points[v] - Vec3(2, 0, 0)).norm() < 1.5) {
            points[v] *= 1.01;
            moved.push_back(v);
        }
    REQUIRE(moved.size() > 5);
    const auto changed = move_vertices(drawing, points, moved);
    CHECK(std::ranges::is_sorted(changed));
    CHECK(changed.size() < drawing.vertices.size() / 2);
    DrawingArrays whole = prepare_drawing(surface.with_positions(points), drawing.layout);
    CHECK(whole.layout == drawing.layout);
    const Eigen::Vector3f shift = (whole.bounds.centre - drawing.bounds.centre).cast<float>();
    REQUIRE(shift.norm() < 0.2F);
    std::size_t different = 0;
    for (std::size_t i = 0; i < whole.vertices.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(whole.vertices[i].position[k] + shift[static_cast<int>(k)] -
                         drawing.vertices[i].position[k]) > 1e-5F)
                ++different;
        different += whole.vertices[i].normal != drawing.vertices[i].normal ? 1 : 0;
    }
    CHECK(different == 0);
}

SCENARIO("A surface without shape changes keeps its layout", "[gpu][render][arrays]") {
    const Surface surface = icosphere(3.0, 3);
    const DrawingArrays first = prepare_drawing(surface);
    const DrawingArrays second = prepare_drawing(surface, first.layout);
    CHECK(first.layout == second.layout);
    CHECK(std::ranges::equal(first.vertices, second.vertices, same));
    const DrawingArrays other = prepare_drawing(icosphere(3.0, 2), first.layout);
    CHECK(other.layout != first.layout);
    CHECK_THROWS_AS(prepare_drawing(Surface{}), InvalidInput);
}

SCENARIO("Every edge is listed once", "[gpu][render][arrays]") {
    const Surface surface = icosphere(3.0, 3);
    CHECK(unique_edges(*surface.topology).size() == surface.triangle_count() * 3 / 2);
}
