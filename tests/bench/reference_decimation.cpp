#include "tests/bench/reference_decimation.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <vtkDecimatePro.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkQuadricDecimation.h>

#include "geometry/kernel/stopwatch.h"
#include "tests/bench/peer_meshes.h"

namespace vesselbench::bench {

namespace {

Surface from_polydata(vtkPolyData* data) {
    Positions points;
    for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
        points.push_back(Vec3::Map(data->GetPoint(v)));
    std::vector<Triangle> triangles;
    vtkNew<vtkIdList> ids;
    data->GetPolys()->InitTraversal();
    while (data->GetPolys()->GetNextCell(ids) != 0)
        triangles.push_back({static_cast<VertexId>(ids->GetId(0)),
                             static_cast<VertexId>(ids->GetId(1)),
                             static_cast<VertexId>(ids->GetId(2))});
    return make_surface(std::move(points), std::move(triangles));
}

double reduction(const Surface& surface, std::size_t triangles) {
    return 1.0 - static_cast<double>(triangles) / static_cast<double>(surface.triangle_count());
}

}  // namespace

DecimationRun vtk_quadric(const Surface& surface, std::size_t triangles) {
    vtkNew<vtkQuadricDecimation> filter;
    filter->SetInputData(polydata(surface, VTK_DOUBLE));
    filter->SetTargetReduction(reduction(surface, triangles));
    filter->VolumePreservationOn();
    const Stopwatch watch;
    filter->Update();
    const double seconds = watch.seconds();
    return {from_polydata(filter->GetOutput()), seconds};
}

DecimationRun vtk_pro(const Surface& surface, std::size_t triangles) {
    vtkNew<vtkDecimatePro> filter;
    filter->SetInputData(polydata(surface, VTK_DOUBLE));
    filter->SetTargetReduction(reduction(surface, triangles));
    filter->PreserveTopologyOn();
    filter->SplittingOff();
    filter->BoundaryVertexDeletionOn();
    const Stopwatch watch;
    filter->Update();
    const double seconds = watch.seconds();
    return {from_polydata(filter->GetOutput()), seconds};
}

DecimationRun cgal_quadric(const Surface& surface, std::size_t triangles) {
    namespace sms = CGAL::Surface_mesh_simplification;
    using Kernel = CGAL::Simple_cartesian<double>;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    using Policies = sms::GarlandHeckbert_plane_policies<Mesh, Kernel>;
    Mesh mesh;
    for (const Vec3& p : surface.points()) mesh.add_vertex({p.x(), p.y(), p.z()});
    for (const auto& [a, b, c] : surface.triangles())
        mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
    const Stopwatch watch;
    const Policies policies(mesh);
    const auto cost = policies.get_cost();
    const sms::Bounded_normal_change_placement<Policies::Get_placement> placement(
        policies.get_placement());
    sms::edge_collapse(mesh, sms::Count_stop_predicate<Mesh>(triangles * 3 / 2),
                       CGAL::parameters::get_cost(cost).get_placement(placement));
    const double seconds = watch.seconds();
    mesh.collect_garbage();
    Positions points;
    for (const auto v : mesh.vertices())
        points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
    std::vector<Triangle> faces;
    for (const auto f : mesh.faces()) {
        const auto h = mesh.halfedge(f);
        faces.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
    }
    return {make_surface(std::move(points), std::move(faces)), seconds};
}

DecimationRun openmesh_quadric(const Surface& surface, std::size_t triangles) {
    OpenMeshSurface mesh;
    add_surface(mesh, surface);
    const Stopwatch watch;
    mesh.request_face_normals();
    mesh.update_face_normals();
    OpenMesh::Decimater::DecimaterT<OpenMeshSurface> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<OpenMeshSurface>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<OpenMeshSurface>::Handle flipping;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.add(flipping);
    decimater.module(flipping).set_max_normal_deviation(75.0F);
    decimater.initialize();
    decimater.decimate_to_faces(0, triangles);
    const double seconds = watch.seconds();
    mesh.garbage_collection();
    Positions points;
    for (const auto v : mesh.vertices())
        points.emplace_back(mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]);
    std::vector<Triangle> faces;
    for (const auto f : mesh.faces()) {
        Triangle triangle{};
        int i = 0;
        for (const auto v : mesh.fv_range(f)) triangle[i++] = static_cast<VertexId>(v.idx());
        faces.push_back(triangle);
    }
    return {make_surface(std::move(points), std::move(faces)), seconds};
}

}  // namespace vesselbench::bench
