#include "meshing/tetrahedra/volume_section.h"

#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "meshing/tetrahedra/quality.h"

using namespace vesselbench;

namespace {

/// The unit cube in six tetrahedra around its diagonal.
VolumeMesh cube_mesh() {
    VolumeMesh mesh;
    for (const int z : {0, 1})
        for (const int y : {0, 1})
            for (const int x : {0, 1}) mesh.points.emplace_back(x, y, z);
    std::array<int, 3> axes = {1, 2, 4};
    do {
        const auto b = static_cast<VertexId>(axes[0]);
        const auto c = static_cast<VertexId>(axes[0] + axes[1]);
        Tetrahedron cell = {0, b, c, 7};
        const Positions& x = mesh.points;
        if ((x[b] - x[0]).cross(x[c] - x[0]).dot(x[7] - x[0]) < 0) std::swap(cell[1], cell[2]);
        mesh.tetrahedra.push_back(cell);
    } while (std::ranges::next_permutation(axes).found);
    return mesh;
}

}  // namespace

SCENARIO("A section through tetrahedra has their values", "[meshing][section]") {
    const VolumeMesh mesh = cube_mesh();
    const auto values = smallest_dihedral_angles(mesh);
    REQUIRE(values.size() == 6);
    for (const double angle : values) CHECK(angle == Approx(45));
    WHEN("the plane is across the cube") {
        const Plane plane{{0, 0, 0.3}, Vec3::UnitZ()};
        const VolumeSection section = section_of(mesh, values, plane, {});
        CHECK(section.cells.size() == 6);
        CHECK(area(section.surface()) == Approx(1));
        CHECK(section.vertex_values().size() == section.surface().vertex_count());
    }
    WHEN("the plane misses it") {
        const Plane plane{{0, 0, 3}, Vec3::UnitZ()};
        CHECK(section_of(mesh, values, plane, {}).cells.empty());
    }
    CHECK_THROWS_AS(section_of(mesh, {}, Plane{}, {}), InvalidInput);
}
