#include "geometry/formats/vtp.h"

#include <new>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "geometry/formats/vtk_arrays.h"
#include "geometry/formats/vtk_mesh.h"
#include "geometry/formats/vtk_xml.h"
#include "geometry/formats/vtk_xml_check.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

/// Turns the cells of one kind into triangles. `cell` counts through all cells of the data set.
class CellReader {
public:
    CellReader(RawSurface& raw, vtkDataArray* parts, std::string file)
        : raw_(raw), parts_(parts), file_(std::move(file)) {}

    void polygons(vtkCellArray* cells, vtkIdType cell) {
        for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i, ++cell) {
            const auto corners = corners_of(cells, i, cell);
            if (corners.size() > 2) append_polygon(raw_.positions, corners, raw_.triangles);
            label(cell);
        }
    }

    void strips(vtkCellArray* cells, vtkIdType cell) {
        for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i, ++cell) {
            const auto corners = corners_of(cells, i, cell);
            for (std::size_t k = 0; k + 2 < corners.size(); ++k) {
                const std::size_t odd = k % 2;  // every second triangle is reversed
                raw_.triangles.push_back({corners[k], corners[k + 1 + odd], corners[k + 2 - odd]});
            }
            label(cell);
        }
    }

private:
    std::vector<VertexId> corners_of(vtkCellArray* cells, vtkIdType i, vtkIdType cell) {
        cells->GetCellAtId(i, ids_);
        std::vector<VertexId> corners;
        for (vtkIdType k = 0; k < ids_->GetNumberOfIds(); ++k) {
            const vtkIdType id = ids_->GetId(k);
            if (id < 0 || id >= static_cast<vtkIdType>(raw_.positions.size()))
                throw InvalidInput(file_ + ", cell " + std::to_string(cell) + " refers to point " +
                                   std::to_string(id) + ", but there are only " +
                                   std::to_string(raw_.positions.size()) + ": the file is damaged");
            corners.push_back(static_cast<VertexId>(id));
        }
        return corners;
    }

    void label(vtkIdType cell) {
        if (parts_)
            raw_.part_ids.resize(raw_.triangles.size(),
                                 static_cast<int>(parts_->GetComponent(cell, 0)));
    }

    RawSurface& raw_;
    vtkDataArray* parts_;
    std::string file_;
    vtkNew<vtkIdList> ids_;
};

RawSurface raw_from(vtkPolyData* data, const std::string& file) {
    RawSurface raw = points_of(data, file);
    for (vtkCellArray* cells : {data->GetPolys(), data->GetStrips()}) check_cells(cells, file);
    CellReader reader(raw, part_array(data), file);
    // Cell data are ordered: lone points, lines, polygons, strips.
    const vtkIdType polygons = data->GetNumberOfVerts() + data->GetNumberOfLines();
    reader.polygons(data->GetPolys(), polygons);
    reader.strips(data->GetStrips(), polygons + data->GetNumberOfPolys());
    if (polygons > 0)
        raw.notes.push_back(std::to_string(polygons) + " lines or isolated points were ignored");
    read_arrays(data, raw);
    return raw;
}

}  // namespace

RawSurface read_vtp(const std::string& path) {
    const std::string bytes = file_content(path), file = bare_name(path);
    if (attribute(require_vtk_xml(bytes, file).front(), "type") != "PolyData")
        throw InvalidInput(file + " contains no surface (type PolyData)");
    try {
        return raw_from(read_poly_data(path), file);
    } catch (const std::bad_alloc&) {
        throw InvalidInput(file + " announces more data than it can hold: it is damaged");
    }
}

void write_vtp(const Surface& surface, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    VtkMesh mesh{.points = surface.points(), .provenance = provenance};
    LoopProgress rows(progress.part(0.0, 0.5), surface.triangle_count(), writing_text(path));
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        rows.step();
        add_cell(mesh, surface.triangles()[t], (*surface.patch_labels)[t] + 1);
    }
    for (const Patch& patch : surface.patches) mesh.patch_names.push_back(patch.name);
    for (const auto& [name, values] : surface.attributes) mesh.attributes[name] = values;
    write_vtk_poly_data(mesh, path, progress.part(0.5, 1.0));
}

}  // namespace vesselbench
