#pragma once

#include <string>

class vtkPolyData;
class vtkUnstructuredGrid;
template <class T>
class vtkSmartPointer;

namespace vesselbench {

/// The poly data of a VTK XML file that require_vtk_xml() accepts, as VTK reads them; nothing is
/// printed.
/// \throw InvalidInput if VTK reports an error
[[nodiscard]] vtkSmartPointer<vtkPolyData> read_poly_data(const std::string& path);

/// The same for an unstructured grid.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> read_unstructured_grid(const std::string& path);

}  // namespace vesselbench
