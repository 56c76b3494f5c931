#include "tests/bench/reference_filters.h"

#include <memory>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSmoothPolyDataFilter.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include "tests/bench/stopwatch.h"

namespace vesselbench::bench {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

vtkSmartPointer<vtkPolyData> polydata(const Surface& surface) {
    vtkNew<vtkPoints> points;
    points->SetNumberOfPoints(static_cast<vtkIdType>(surface.vertex_count()));
    for (std::size_t v = 0; v < surface.vertex_count(); ++v)
        points->SetPoint(static_cast<vtkIdType>(v), surface.points()[v].data());
    vtkNew<vtkCellArray> cells;
    for (const Triangle& t : surface.triangles()) {
        const vtkIdType ids[3] = {t[0], t[1], t[2]};
        cells->InsertNextCell(3, ids);
    }
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points);
    result->SetPolys(cells);
    return result;
}

template <class Filter>
double timed(Filter& filter) {
    const Stopwatch watch;
    filter.Update();
    return watch.seconds();
}

/// A new polydata every time, so that no cells or links stay from the run before.
vtkSmartPointer<vtkPolyData> bare_copy(vtkPolyData* from) {
    auto copy = vtkSmartPointer<vtkPolyData>::New();
    copy->SetPoints(from->GetPoints());
    copy->SetPolys(from->GetPolys());
    return copy;
}

}  // namespace

Run vtk_laplace(const Surface& surface, int iterations) {
    return [input = polydata(surface), iterations] {
        vtkNew<vtkSmoothPolyDataFilter> filter;
        filter->SetInputData(bare_copy(input));
        filter->SetNumberOfIterations(iterations);
        filter->SetRelaxationFactor(0.5);
        filter->FeatureEdgeSmoothingOff();
        filter->BoundarySmoothingOff();
        return timed(*filter.Get());
    };
}

Run vtk_windowed_sinc(const Surface& surface, int iterations) {
    return [input = polydata(surface), iterations] {
        vtkNew<vtkWindowedSincPolyDataFilter> filter;
        filter->SetInputData(bare_copy(input));
        filter->SetNumberOfIterations(iterations);
        filter->SetPassBand(0.1);
        filter->NormalizeCoordinatesOn();
        filter->FeatureEdgeSmoothingOff();
        filter->BoundarySmoothingOff();
        return timed(*filter.Get());
    };
}

Run openmesh_laplace(const Surface& surface, int iterations) {
    auto mesh = std::make_shared<Mesh>();
    mesh->request_vertex_status();
    mesh->request_face_normals();
    mesh->request_vertex_normals();
    for (const Vec3& p : surface.points()) mesh->add_vertex(OpenMesh::Vec3d(p.x(), p.y(), p.z()));
    for (const Triangle& t : surface.triangles())
        mesh->add_face(Mesh::VertexHandle(static_cast<int>(t[0])),
                       Mesh::VertexHandle(static_cast<int>(t[1])),
                       Mesh::VertexHandle(static_cast<int>(t[2])));
    return [mesh, iterations, points = surface.points()] {
        for (std::size_t v = 0; v < points.size(); ++v)
            mesh->set_point(Mesh::VertexHandle(static_cast<int>(v)),
                            OpenMesh::Vec3d(points[v].x(), points[v].y(), points[v].z()));
        using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh>;
        Smoother smoother(*mesh);
        const Stopwatch watch;
        smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
        smoother.smooth(static_cast<unsigned>(iterations));
        return watch.seconds();
    };
}

}  // namespace vesselbench::bench
