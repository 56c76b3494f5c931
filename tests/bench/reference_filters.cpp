#include "tests/bench/reference_filters.h"

#include <memory>

#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <vtkSmoothPolyDataFilter.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include "geometry/kernel/stopwatch.h"
#include "tests/bench/peer_meshes.h"

namespace vesselbench::bench {

namespace {

template <class Filter>
double timed(Filter& filter) {
    const Stopwatch watch;
    filter.Update();
    return watch.seconds();
}

/// A new polydata each time, so that no cells or links remain from the previous run.
vtkSmartPointer<vtkPolyData> bare_copy(vtkPolyData* from) {
    auto copy = vtkSmartPointer<vtkPolyData>::New();
    copy->SetPoints(from->GetPoints());
    copy->SetPolys(from->GetPolys());
    return copy;
}

}  // namespace

Run vtk_laplace(const Surface& surface, int iterations) {
    return [input = polydata(surface, VTK_FLOAT), iterations] {
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
    return [input = polydata(surface, VTK_FLOAT), iterations] {
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
    auto mesh = std::make_shared<OpenMeshSurface>();
    mesh->request_vertex_status();
    mesh->request_face_normals();
    mesh->request_vertex_normals();
    add_surface(*mesh, surface);
    return [mesh, iterations, points = surface.points()] {
        for (std::size_t v = 0; v < points.size(); ++v)
            mesh->set_point(OpenMeshSurface::VertexHandle(static_cast<int>(v)),
                            OpenMesh::Vec3d(points[v].x(), points[v].y(), points[v].z()));
        using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<OpenMeshSurface>;
        Smoother smoother(*mesh);
        const Stopwatch watch;
        smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
        smoother.smooth(static_cast<unsigned>(iterations));
        return watch.seconds();
    };
}

}  // namespace vesselbench::bench
