#include "geometry/formats/vtu.h"

#include <new>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "geometry/formats/grid_cells.h"
#include "geometry/formats/vtk_arrays.h"
#include "geometry/formats/vtk_xml.h"
#include "geometry/formats/vtk_xml_check.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

GridCells cells_of(vtkUnstructuredGrid* grid, std::size_t points, const std::string& file) {
    GridCells cells;
    vtkCellArray* const list = grid->GetCells();
    vtkUnsignedCharArray* const types = grid->GetCellTypesArray();
    if (list == nullptr || types == nullptr || list->GetNumberOfCells() == 0) return cells;
    check_cells(list, file);
    if (types->GetNumberOfTuples() != list->GetNumberOfCells())
        throw InvalidInput(file +
                           " has another number of cells than of their types: it is damaged");
    vtkDataArray* const parts = part_array(grid);
    const vtkNew<vtkIdList> ids;
    std::vector<VertexId> corners;
    for (vtkIdType i = 0; i < list->GetNumberOfCells(); ++i) {
        list->GetCellAtId(i, ids.Get());
        corners.clear();
        for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
            const vtkIdType id = ids->GetId(k);
            if (id < 0 || id >= static_cast<vtkIdType>(points))
                throw InvalidInput(file + ", cell " + std::to_string(i) + " refers to point " +
                                   std::to_string(id) + ", but there are only " +
                                   std::to_string(points) + ": the file is damaged");
            corners.push_back(static_cast<VertexId>(id));
        }
        cells.add(types->GetValue(i), corners);
        if (parts != nullptr) cells.regions.push_back(static_cast<int>(parts->GetComponent(i, 0)));
    }
    return cells;
}

RawSurface raw_from(vtkUnstructuredGrid* grid, const std::string& file) {
    RawSurface raw = points_of(grid, file);
    append_grid_surface(cells_of(grid, raw.positions.size(), file), file, raw);
    read_arrays(grid, raw);
    return raw;
}

}  // namespace

RawSurface read_vtu_surface(const std::string& path) {
    const std::string bytes = file_content(path), file = bare_name(path);
    if (attribute(require_vtk_xml(bytes, file).front(), "type") != "UnstructuredGrid")
        throw InvalidInput(file + " contains no unstructured grid");
    try {
        return raw_from(read_unstructured_grid(path), file);
    } catch (const std::bad_alloc&) {
        throw InvalidInput(file + " announces more data than it can hold: it is damaged");
    }
}

}  // namespace vesselbench
