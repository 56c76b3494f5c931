#pragma once

#include <string>

#include "geometry/formats/raw_surface.h"

class vtkCellArray;
class vtkDataArray;
class vtkPointSet;

namespace vesselbench {

/// A surface with the points of VTK's data, and no triangles.
/// \throw InvalidInput if a coordinate is not finite
[[nodiscard]] RawSurface points_of(vtkPointSet* data, const std::string& file);

/// The cell array that defines parts; null if there is no known one.
[[nodiscard]] vtkDataArray* part_array(vtkPointSet* data);

/// A cell array with offsets outside its connectivity would make VTK read beyond it.
/// \throw InvalidInput if there are such offsets
void check_cells(vtkCellArray* cells, const std::string& file);

/// Reads names of parts, the unit and the axes that the data state, and the point arrays, which
/// become attributes.
void read_arrays(vtkPointSet* data, RawSurface& raw);

}  // namespace vesselbench
