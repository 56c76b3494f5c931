#include "geometry/image/flying_edges.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace vesselbench {

namespace {

GridSurface zero_set(vtkDataArray* values, const GridFrame& grid) {
    vtkNew<vtkImageData> data;
    data->SetDimensions(grid.size.data());
    data->SetOrigin(grid.origin.data());
    data->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
    data->GetPointData()->SetScalars(values);
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetInputData(data);
    filter->SetValue(0, 0.0);
    filter->ComputeNormalsOff();
    filter->ComputeGradientsOff();
    filter->ComputeScalarsOff();
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    GridSurface surface;
    surface.points.resize(static_cast<std::size_t>(output->GetNumberOfPoints()));
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
        double p[3];
        output->GetPoint(static_cast<vtkIdType>(v), p);
        surface.points[v] = {static_cast<float>(p[0]), static_cast<float>(p[1]),
                             static_cast<float>(p[2])};
    }
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    vtkCellArray* cells = output->GetPolys();
    for (cells->InitTraversal(); cells->GetNextCell(count, ids);)
        surface.triangles.push_back({static_cast<VertexId>(ids[0]), static_cast<VertexId>(ids[1]),
                                     static_cast<VertexId>(ids[2])});
    return surface;
}

/// The values as a VTK array that does not own them; VTK only reads, but does not accept const.
template <class Array, class Number>
GridSurface zero_set_of(std::span<const Number> values, const GridFrame& grid) {
    vtkNew<Array> array;
    array->SetArray(const_cast<Number*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
    return zero_set(array, grid);
}

}  // namespace

GridSurface flying_edges(std::span<const float> values, const GridFrame& grid) {
    return zero_set_of<vtkFloatArray>(values, grid);
}

GridSurface flying_edges(std::span<const double> values, const GridFrame& grid) {
    return zero_set_of<vtkDoubleArray>(values, grid);
}

}  // namespace vesselbench
