#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

// A surface in the data structures of the libraries that ours is timed against.

/// \param precision of the points: VTK_FLOAT, VTK's default, or VTK_DOUBLE
[[nodiscard]] inline vtkSmartPointer<vtkPolyData> polydata(const Surface& surface, int precision) {
    vtkNew<vtkPoints> points;
    points->SetDataType(precision);
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

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using OpenMeshSurface = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

inline void add_surface(OpenMeshSurface& mesh, const Surface& surface) {
    for (const Vec3& p : surface.points()) mesh.add_vertex(OpenMesh::Vec3d(p.x(), p.y(), p.z()));
    for (const Triangle& t : surface.triangles())
        mesh.add_face(mesh.vertex_handle(t[0]), mesh.vertex_handle(t[1]), mesh.vertex_handle(t[2]));
}

}  // namespace vesselbench::bench
