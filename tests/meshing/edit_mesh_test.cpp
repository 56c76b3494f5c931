#include "meshing/remeshing/edit_mesh.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Twins, fans and leaving half-edges agree with each other everywhere.
void check_consistent(const EditMesh& mesh) {
    for (EditMesh::HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.origin(h) == EditMesh::kNone) continue;
        const auto twin = mesh.twin(h);
        if (mesh.twin(twin) != h || mesh.origin(twin) != mesh.target(h)) FAIL("twin of " << h);
        const auto leaving = mesh.leaving(mesh.origin(h));
        if (mesh.origin(leaving) != mesh.origin(h)) FAIL("leaving " << mesh.origin(h));
    }
}

Surface surface_of(const EditMesh& mesh, const Surface& source) {
    std::vector<VertexId> kept;
    return mesh.to_surface(source.patches, kept);
}

}  // namespace

SCENARIO("A mesh without edits gives the same surface", "[meshing][edit-mesh]") {
    for (const Surface& source : {closed_tube(2.0, 5.0, 12, 6), open_tube(2.0, 5.0, 12, 6)}) {
        const EditMesh mesh(source);
        check_consistent(mesh);
        const Surface same = surface_of(mesh, source);
        CHECK(same.points() == source.points());
        CHECK(std::ranges::equal(same.triangles(), source.triangles()));
        CHECK(*same.patch_labels == *source.patch_labels);
    }
}

SCENARIO("Splits, flips and collapses keep the mesh a manifold", "[meshing][edit-mesh]") {
    for (const Surface& source : {closed_tube(2.0, 5.0, 12, 6), open_tube(2.0, 5.0, 12, 6)}) {
        const Connectivity before = connectivity(*source.topology);
        EditMesh mesh(source);
        const std::size_t edges = mesh.half_edge_count();
        for (EditMesh::HalfEdge h = 0; h < edges; h += 7)
            if (!mesh.is_hole(mesh.patch_at(h)))
                mesh.split(h, 0.5 * (mesh.points[mesh.origin(h)] + mesh.points[mesh.target(h)]));
        check_consistent(mesh);
        for (EditMesh::HalfEdge h = 0; h < mesh.half_edge_count(); h += 3)
            if (mesh.can_flip(h)) mesh.flip(h);
        check_consistent(mesh);
        int collapsed = 0;
        for (EditMesh::HalfEdge h = 0; h < mesh.half_edge_count(); h += 5)
            if (mesh.origin(h) != EditMesh::kNone && mesh.can_collapse(h))
                mesh.collapse(h), ++collapsed;
        CHECK(collapsed > 20);
        check_consistent(mesh);
        const Positions places = mesh.points;
        const std::vector<VertexId> former = mesh.compact();
        check_consistent(mesh);
        CHECK(former.size() == mesh.vertex_count());
        CHECK(mesh.vertex_count() == places.size() - static_cast<std::size_t>(collapsed));
        CHECK(std::ranges::equal(former, mesh.points,
                                 [&](VertexId v, const Vec3& p) { return places[v] == p; }));
        const Connectivity after = connectivity(*surface_of(mesh, source).topology);
        CHECK(after.manifold);
        CHECK(after.oriented);
        CHECK(after.boundary_loops == before.boundary_loops);
        CHECK(after.genus == before.genus);
    }
}

SCENARIO("Edges between patches are features and do not flip", "[meshing][edit-mesh]") {
    const Surface tube = closed_tube(2.0, 5.0, 12, 6);
    EditMesh mesh(tube);
    int features = 0;
    for (EditMesh::HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        features += mesh.is_feature(h);
        if (mesh.is_feature(h)) CHECK_FALSE(mesh.can_flip(h));
    }
    CHECK(features == 2 * 2 * 12);
}

SCENARIO("A surface that is not an oriented manifold is rejected with its place",
         "[meshing][edit-mesh]") {
    const Positions points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0),
                              Vec3(0, 0, 1)};
    CHECK_THROWS_WITH(EditMesh(make_surface(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})),
                      Catch::Contains("near"));
    CHECK_THROWS_AS(EditMesh(make_surface(points, {{0, 1, 2}, {0, 1, 3}})), InvalidInput);
    CHECK_THROWS_AS(EditMesh(make_surface(points, {{0, 1, 2}, {0, 3, 4}})), InvalidInput);
}

SCENARIO("What is near on a compact mesh is near in memory", "[meshing][edit-mesh]") {
    const Surface source = closed_tube(2.0, 30.0, 48, 200);
    std::vector<VertexId> shuffled(source.vertex_count());
    std::iota(shuffled.begin(), shuffled.end(), VertexId{0});
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
    Positions points(shuffled.size());
    for (std::size_t v = 0; v < points.size(); ++v) points[shuffled[v]] = source.points()[v];
    std::vector<Triangle> triangles(source.triangles().begin(), source.triangles().end());
    for (Triangle& triangle : triangles)
        for (VertexId& v : triangle) v = shuffled[v];
    EditMesh mesh(make_surface(std::move(points), std::move(triangles), *source.patch_labels,
                               source.patches));
    const auto far_neighbours = [&] {
        std::size_t far = 0;
        for (EditMesh::HalfEdge h = 0; h < mesh.half_edge_count(); ++h)
            far += std::max(mesh.origin(h), mesh.target(h)) -
                               std::min(mesh.origin(h), mesh.target(h)) >
                           mesh.vertex_count() / 8
                       ? 1
                       : 0;
        return static_cast<double>(far) / static_cast<double>(mesh.half_edge_count());
    };
    CHECK(far_neighbours() > 0.5);
    mesh.compact();
    CHECK(far_neighbours() < 0.1);
}
