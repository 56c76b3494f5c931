#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/kernel/errors.h"
#include "meshing/tetrahedra/cell_order.h"
#include "meshing/tetrahedra/optimise.h"
#include "meshing/tetrahedra/quality.h"

using namespace vesselbench;

namespace {

VolumeMesh one_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    VolumeMesh mesh;
    mesh.points = {a, b, c, d};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    for (const Triangle& face : faces_of(mesh.tetrahedra[0])) mesh.boundary.push_back(face);
    mesh.boundary_patches.assign(4, 0);
    mesh.patches = {{"wall", PatchKind::Wall}};
    return mesh;
}

VolumeMesh regular_tetrahedron() {
    return one_tetrahedron({1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1});
}

// Twelve cells around the middle of a cube, which `centre` moves.
VolumeMesh cube_star(const Vec3& centre) {
    VolumeMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    mesh.points.push_back(centre);
    mesh.boundary = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& [a, b, c] : mesh.boundary) mesh.tetrahedra.push_back({a, c, b, 8});
    mesh.boundary_patches.assign(12, 0);
    mesh.patches = {{"wall", PatchKind::Wall}};
    return mesh;
}

// A box of n^3 cubes of six cells each, whose inner points are moved at random.
VolumeMesh shaken_box(int n) {
    VolumeMesh mesh;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    const auto is_inner = [n](int i) { return 0 < i && i < n; };
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                mesh.points.emplace_back(i, j, k);
                if (is_inner(i) && is_inner(j) && is_inner(k))
                    mesh.points.back() += Vec3(shift(random), shift(random), shift(random));
            }
    const auto at = [n](int i, int j, int k) {
        return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i);
    };
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                std::array<int, 3> axes = {0, 1, 2};
                do {  // along the axes in every order from one corner of the cube to the other
                    std::array<int, 3> p = {i, j, k};
                    Tetrahedron cell{at(i, j, k)};
                    for (int step = 0; step < 3; ++step) {
                        ++p[axes[step]];
                        cell[step + 1] = at(p[0], p[1], p[2]);
                    }
                    const auto& q = mesh.points;
                    const Vec3 &a = q[cell[0]], &b = q[cell[1]], &c = q[cell[2]], &d = q[cell[3]];
                    if ((b - a).cross(c - a).dot(d - a) < 0.0) std::swap(cell[2], cell[3]);
                    mesh.tetrahedra.push_back(cell);
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
    std::map<Triangle, Triangle> outer;
    for (const Tetrahedron& cell : mesh.tetrahedra)
        for (const Triangle& face : faces_of(cell)) {
            Triangle key = face;
            std::sort(key.begin(), key.end());
            if (!outer.emplace(key, face).second) outer.erase(key);
        }
    for (const auto& [key, face] : outer) mesh.boundary.push_back(face);
    mesh.boundary_patches.assign(mesh.boundary.size(), 0);
    mesh.patches = {{"wall", PatchKind::Wall}};
    return mesh;
}

}  // namespace

SCENARIO("quality figures of known tetrahedra", "[meshing][quality]") {
    GIVEN("a regular tetrahedron of edge 2 sqrt 2") {
        const VolumeQuality quality = volume_quality(regular_tetrahedron());
        THEN("its angles are arccos(1/3)") {
            const double angle = std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi;
            CHECK(quality.smallest_dihedral == Approx(angle));
            CHECK(quality.largest_dihedral == Approx(angle));
        }
        THEN("volume and edge are known") {
            CHECK(quality.volume == Approx(8.0 / 3.0));
            CHECK(quality.mean_edge == Approx(2.0 * std::sqrt(2.0)));
            CHECK(quality.largest_skewness == Approx(0.0).margin(1e-12));
        }
    }
    GIVEN("two equal cells that share a face") {
        VolumeMesh mesh = one_tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.0 / 3, 1.0 / 3, 1});
        mesh.points.emplace_back(1.0 / 3, 1.0 / 3, -1);
        mesh.tetrahedra.push_back({0, 2, 1, 4});
        mesh.boundary.clear();
        for (const Tetrahedron& cell : mesh.tetrahedra)
            for (const Triangle& face : faces_of(cell))
                if (face[0] + face[1] + face[2] > 3) mesh.boundary.push_back(face);
        mesh.boundary_patches.assign(mesh.boundary.size(), 0);
        const VolumeQuality quality = volume_quality(mesh);
        THEN("the face is orthogonal, unskewed and between equal volumes") {
            CHECK(quality.inner_faces == 1);
            CHECK(quality.faces == 7);
            CHECK(quality.largest_non_orthogonality == Approx(0.0).margin(1e-5));
            CHECK(quality.largest_volume_ratio == Approx(1.0));
        }
        THEN("faces come in OpenFOAM's order") {
            const auto faces = mesh_faces(mesh);
            CHECK(faces.front().owner == 0);
            CHECK(faces.front().neighbour == 1);
            CHECK(faces.back().neighbour == MeshFace::kOutside);
        }
    }
    GIVEN("a mesh whose boundary list lacks a face") {
        VolumeMesh mesh = regular_tetrahedron();
        mesh.boundary.pop_back();
        mesh.boundary_patches.pop_back();
        THEN("that is an error") {
            CHECK_THROWS_AS(volume_quality(mesh), InvalidInput);
        }
    }
}

SCENARIO("improvement moves inner vertices to better places", "[meshing][optimise]") {
    GIVEN("a cube whose middle vertex sits in a corner") {
        const VolumeMesh poor = cube_star({0.1, 0.1, 0.15});
        const VolumeMesh better = optimised(poor, {.rounds = 3}, {});
        THEN("the smallest angle grows, the volume and the boundary stay") {
            const auto before = volume_quality(poor), after = volume_quality(better);
            CHECK(after.smallest_dihedral > 2.0 * before.smallest_dihedral);
            CHECK(before.largest_non_orthogonality > 1.0);
            CHECK(largest_non_orthogonality(poor, mesh_faces(poor)) ==
                  before.largest_non_orthogonality);
            CHECK(after.volume == Approx(1.0).epsilon(1e-12));
            CHECK(after.smallest_cell > 0.0);
            for (std::size_t v = 0; v < 8; ++v) CHECK(better.points[v] == poor.points[v]);
            CHECK(better.boundary == poor.boundary);
        }
    }
    GIVEN("a box of shaken cells, of several ranges of vertices") {
        const VolumeMesh poor = shaken_box(27);
        REQUIRE(poor.points.size() > 20'000);
        const VolumeMesh better = optimised(poor, {.rounds = 2}, {});
        THEN("the cells get better, and still fill the box") {
            const auto before = volume_quality(poor), after = volume_quality(better);
            CHECK(after.mean_smallest_dihedral > before.mean_smallest_dihedral + 5.0);
            CHECK(after.smallest_dihedral > before.smallest_dihedral);
            CHECK(after.volume == Approx(std::pow(27.0, 3)).epsilon(1e-9));
            CHECK(after.smallest_cell > 0.0);
        }
        THEN("one thread gives the same bits") {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            const VolumeMesh again = optimised(poor, {.rounds = 2}, {});
            CHECK(again.points == better.points);
            CHECK(again.tetrahedra == better.tetrahedra);
        }
    }
    GIVEN("a cube of cells in any order") {
        CellNeighbours neighbours;
        const VolumeMesh sorted = in_cell_order(cube_star({0.5, 0.5, 0.5}), neighbours);
        THEN("renumbering loses no cell") {
            CHECK(sorted.tetrahedra.size() == 12);
            CHECK(volume(sorted) == Approx(1.0));
            CHECK(neighbours == cell_neighbours(sorted));
        }
    }
}
