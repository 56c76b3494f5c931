#include "tests/bench/reference_remeshing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"

namespace vesselbench::bench {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr unsigned kIterations = 5;

struct LabelledMesh {
    Mesh mesh;
    Mesh::Property_map<Mesh::Face_index, std::uint16_t> patch;
    Mesh::Property_map<Mesh::Edge_index, bool> feature;
};

LabelledMesh to_mesh(const Surface& surface) {
    LabelledMesh result;
    Mesh& mesh = result.mesh;
    result.patch = mesh.add_property_map<Mesh::Face_index, std::uint16_t>("f:patch", 0).first;
    result.feature = mesh.add_property_map<Mesh::Edge_index, bool>("e:feature", false).first;
    for (const Vec3& p : surface.points()) mesh.add_vertex({p.x(), p.y(), p.z()});
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        const auto face =
            mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
        if (face == Mesh::null_face())
            throw InvalidInput("the surface is not an oriented manifold; repair it first");
        result.patch[face] = (*surface.patch_labels)[t];
    }
    for (const auto e : mesh.edges()) {
        const auto h = mesh.halfedge(e);
        result.feature[e] = mesh.is_border(e) ||
                            result.patch[mesh.face(h)] != result.patch[mesh.face(mesh.opposite(h))];
    }
    return result;
}

Surface to_surface(const LabelledMesh& labelled, const std::vector<Patch>& patches) {
    const Mesh& mesh = labelled.mesh;
    std::vector<VertexId> number(mesh.num_vertices() + mesh.number_of_removed_vertices());
    Positions points;
    for (const auto v : mesh.vertices()) {
        number[v] = static_cast<VertexId>(points.size());
        const auto& p = mesh.point(v);
        points.emplace_back(p.x(), p.y(), p.z());
    }
    std::vector<Triangle> triangles;
    PatchLabels labels;
    for (const auto f : mesh.faces()) {
        const auto h = mesh.halfedge(f);
        triangles.push_back(
            {number[mesh.source(h)], number[mesh.target(h)], number[mesh.target(mesh.next(h))]});
        labels.push_back(labelled.patch[f]);
    }
    return make_surface(std::move(points), std::move(triangles), std::move(labels), patches);
}

}  // namespace

RemeshingRun cgal_isotropic(const Surface& surface, double edge) {
    LabelledMesh labelled = to_mesh(surface);
    const Stopwatch watch;
    const std::clock_t start = std::clock();
    pmp::isotropic_remeshing(faces(labelled.mesh), edge, labelled.mesh,
                             CGAL::parameters::number_of_iterations(kIterations)
                                 .number_of_relaxation_steps(3)
                                 .face_patch_map(labelled.patch)
                                 .edge_is_constrained_map(labelled.feature)
                                 .relax_constraints(true));
    const double seconds = watch.seconds(), processor = processor_seconds(start);
    labelled.mesh.collect_garbage();
    return {to_surface(labelled, surface.patches), seconds, processor};
}

}  // namespace vesselbench::bench
