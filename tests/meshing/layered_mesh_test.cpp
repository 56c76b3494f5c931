#include "meshing/layers/layered_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "meshing/tetrahedra/volume_section.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

// Sound: fills the surface, keeps the wall's points, and no prism is bad.
void check_layered(const LayeredMesh& result, const Surface& surface, int layers) {
    const VolumeMesh& mesh = result.mesh;
    CHECK(volume(mesh) == Approx(volume(surface)).epsilon(1e-9));
    CHECK(result.report.quality.volume == Approx(volume(surface)).epsilon(1e-9));
    CHECK(result.report.quality.smallest_cell > 0.0);
    CHECK(result.report.quality.smallest_scaled_jacobian >= 0.2);
    CHECK(result.report.quality.largest_non_orthogonality < 70.0);
    CHECK(result.report.quality.largest_skewness < 4.0);
    const auto wall = static_cast<std::size_t>(
        std::count(surface.patch_labels->begin(), surface.patch_labels->end(), 0));
    CHECK(mesh.prisms.size() == wall * static_cast<std::size_t>(layers));
    CHECK(mesh.boundary.size() == surface.triangle_count());
    const Surface boundary = boundary_surface(mesh);
    CHECK(connectivity(*boundary.topology).closed);
    for (const PatchMeasures& before : measure_patches(surface)) {
        const auto patches = measure_patches(boundary);
        const auto after = std::ranges::find(patches, before.name, &PatchMeasures::name);
        REQUIRE(after != patches.end());
        CHECK(after->area == Approx(before.area).epsilon(1e-9));
        if (before.kind != PatchKind::Wall) CHECK(after->flatness < 1e-9);
    }
}

}  // namespace

SCENARIO("prisms lie along the wall, tetrahedra inside", "[meshing][layers]") {
    for (const int layers : {1, 4}) {
        const Surface tube = test::fine_tube(2.0, 8.0, 24);
        const LayeredMesh result = layered_mesh(tube, {}, {.layers = layers});
        check_layered(result, tube, layers);
    }
    GIVEN("a closed surface without openings") {
        const Surface sphere = test::icosphere(3.0, 3);
        check_layered(layered_mesh(sphere, {}, {.layers = 2}), sphere, 2);
    }
    GIVEN("a tube whose ends are cut askew") {
        const Surface askew = test::mapped(test::fine_tube(2.0, 12.0, 30), [](const Vec3& p) {
            return Vec3(test::skew_rotation() *
                        Vec3(p.x(), p.y(), p.z() + 0.4 * p.x() * (1.0 - p.z() / 6.0)));
        });
        THEN("openings stay flat, and layers as thick as wished") {
            const LayeredMesh result = layered_mesh(askew, {}, {.layers = 4});
            check_layered(result, askew, 4);
            CHECK(result.layers.half == 0.0);
        }
    }
    GIVEN("two runs") {
        const Surface tube = test::fine_tube(2.0, 6.0, 18);
        const LayeredMesh one = layered_mesh(tube, {}, {.layers = 3}),
                          other = layered_mesh(tube, {}, {.layers = 3});
        THEN("they give the same bits") {
            CHECK(one.mesh.points == other.mesh.points);
            CHECK(one.mesh.tetrahedra == other.mesh.tetrahedra);
            CHECK(one.mesh.prisms == other.mesh.prisms);
        }
    }
}

SCENARIO("prisms count as cells", "[meshing][layers]") {
    const Surface tube = test::fine_tube(2.0, 10.0, 24);
    GIVEN("a number of cells") {
        const LayeredMesh result = layered_mesh(tube, {.cells = 20000.0}, {.layers = 4});
        THEN("prisms and tetrahedra together are so many") {
            CHECK(static_cast<double>(result.mesh.cell_count()) == Approx(20000.0).epsilon(0.1));
        }
    }
    GIVEN("fewer cells than the prisms are") {
        THEN("that is refused") {
            CHECK_THROWS_AS(layered_mesh(tube, {.cells = 4000.0}, {.layers = 4}), DiagnosedFailure);
        }
    }
}

SCENARIO("layers that the lumen has no room for are refused", "[meshing][layers]") {
    const Surface tube = test::fine_tube(2.0, 6.0, 18);
    CHECK_THROWS_AS(layered_mesh(tube, {}, {.layers = 4, .thickness_mm = 3.0}), DiagnosedFailure);
    CHECK_NOTHROW(layered_mesh(tube, {}, {.layers = 4, .thickness_mm = 0.8}));
}

SCENARIO("a section through the mesh cuts its prisms", "[meshing][layers]") {
    const VolumeMesh mesh = layered_mesh(test::fine_tube(2.0, 8.0, 24), {}, {.layers = 3}).mesh;
    const std::vector<double> values = smallest_dihedral_angles(mesh);
    REQUIRE(values.size() == mesh.cell_count());
    const VolumeSection section = section_of(mesh, values, {Vec3(0, 0, 3.9), Vec3::UnitZ()}, {});
    const Surface cut = section.surface();
    // The 24-gon, to which its triangles add and from which they take a little.
    CHECK(area(cut) == Approx(12.0 * 4.0 * std::sin(2.0 * 3.14159265 / 24.0)).epsilon(0.02));
    for (const double value : section.values) CHECK(value > 5.0);
}

SCENARIO("figures of a known prism", "[meshing][quality][layers]") {
    VolumeMesh mesh;
    mesh.points = {{0, 0, 1}, {1, 0, 1}, {0.5, std::sqrt(0.75), 1},
                   {0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
    mesh.prisms = {{0, 1, 2, 3, 4, 5}};
    mesh.boundary = {{0, 1, 2}, {3, 5, 4}};
    mesh.boundary_patches = {0, 0};
    mesh.boundary_sides = {{0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
    mesh.side_patches = {0, 0, 0};
    mesh.patches = {{"wall", PatchKind::Wall}};
    const VolumeQuality quality = volume_quality(mesh);
    CHECK(quality.volume == Approx(std::sqrt(3.0) / 4.0));
    CHECK(volume(mesh) == Approx(std::sqrt(3.0) / 4.0));
    CHECK(quality.smallest_dihedral == Approx(60.0));
    CHECK(quality.largest_dihedral == Approx(90.0));
    CHECK(quality.smallest_scaled_jacobian == Approx(1.0));
    CHECK(quality.mean_edge == Approx(1.0));
    CHECK(quality.faces == 5);
    std::swap(mesh.prisms[0][0], mesh.prisms[0][1]);
    CHECK(scaled_jacobian(mesh.points, mesh.prisms[0]) < 0.0);
}
