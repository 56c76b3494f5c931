#include "geometry/editing/hole_filling.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface without(const Surface& surface, const std::function<bool(const Vec3&)>& gone) {
    std::vector<std::uint8_t> removed;
    for (const auto& [a, b, c] : surface.triangles())
        removed.push_back(
            gone((surface.points()[a] + surface.points()[b] + surface.points()[c]) / 3.0));
    EditableSurface edited(surface);
    edited.remove(removed);
    return edited.to_surface();
}

}  // namespace

SCENARIO("A hole in a sphere is filled so that the sphere continues", "[geometry][hole]") {
    Surface sphere = icosphere(10.0, 4);
    std::vector<double> height;
    for (const Vec3& p : sphere.points()) height.push_back(p.z());
    sphere.attributes["height"] = std::make_shared<const std::vector<double>>(height);
    const Surface holed = without(sphere, [](const Vec3& p) { return p.z() > 9.0; });
    const auto loops = holed.topology->boundary_loops();
    REQUIRE(loops.size() == 1);
    const FilledHole filled = fill_hole(holed, loops[0]);
    THEN("it is closed, and the new part is round") {
        CHECK(is_closed_manifold(filled.surface));
        CHECK(enclosed_volume(filled.surface) == Approx(enclosed_volume(sphere)).epsilon(5e-3));
        for (std::size_t v = filled.first_new_vertex; v < filled.surface.vertex_count(); ++v)
            CHECK(filled.surface.points()[v].norm() == Approx(10.0).epsilon(0.02));
    }
    THEN("what was there stays bit for bit, with its attributes") {
        REQUIRE(filled.first_new_vertex == holed.vertex_count());
        REQUIRE(filled.first_new_triangle == holed.triangle_count());
        for (std::size_t v = 0; v < holed.vertex_count(); ++v)
            CHECK(filled.surface.points()[v] == holed.points()[v]);
        CHECK(filled.surface.attributes.at("height")->size() == filled.surface.vertex_count());
        CHECK(filled.surface.attributes.at("height")->at(5) ==
              holed.attributes.at("height")->at(5));
    }
}

SCENARIO("Filling an end of a tube leaves the other one open", "[geometry][hole]") {
    const Surface tube = open_tube(2.0, 20.0, 40, 60);
    const auto loops = tube.topology->boundary_loops();
    REQUIRE(loops.size() == 2);
    const Surface filled = fill_hole(tube, loops[0], 0).surface;
    CHECK(filled.topology->boundary_loops().size() == 1);
    CHECK(filled.patches.size() == 1);
    CHECK_THROWS_AS(fill_hole(tube, std::vector<VertexId>{0, 1}), InvalidInput);
}
