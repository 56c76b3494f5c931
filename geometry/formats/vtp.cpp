#include "geometry/formats/vtp.h"

#include <new>

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include "geometry/formats/vtk_mesh.h"
#include "geometry/formats/vtk_xml.h"
#include "geometry/formats/vtk_xml_check.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

RawSurface points_of(vtkPolyData* data, const std::string& file) {
    RawSurface raw;
    raw.positions.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        Vec3& p = raw.positions[static_cast<std::size_t>(i)];
        data->GetPoint(i, p.data());
        if (!p.allFinite())
            throw InvalidInput(file + ", point " + std::to_string(i) +
                               ": a coordinate is not finite; the program that wrote the file "
                               "failed; export it again");
    }
    return raw;
}

/// The cell array that defines parts; none if the file has no known one.
vtkDataArray* part_array(vtkPolyData* data) {
    for (const char* name : {"CellEntityIds", kSimVascularFaces})
        if (vtkDataArray* found = data->GetCellData()->GetArray(name))
            if (found->GetNumberOfComponents() == 1 &&
                found->GetNumberOfTuples() == data->GetNumberOfCells())
                return found;
    return nullptr;
}

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

/// A cell array with offsets outside its connectivity would make VTK read beyond it.
void check_cells(vtkCellArray* cells, const std::string& file) {
    vtkIdType before = 0;
    const vtkIdType limit = cells->GetNumberOfConnectivityIds();
    for (vtkIdType i = 0; i <= cells->GetNumberOfCells() && cells->GetNumberOfCells() > 0; ++i) {
        const auto offset = static_cast<vtkIdType>(cells->GetOffsetsArray()->GetComponent(i, 0));
        if (offset < before || offset > limit)
            throw InvalidInput(
                file + ", cell " + std::to_string(i) +
                ": its offset in the list of corners is out of range: the file is damaged");
        before = offset;
    }
}

void read_names(vtkPolyData* data, RawSurface& raw) {
    vtkFieldData* fields = data->GetFieldData();
    if (auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("PatchNames")))
        for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
            raw.part_names[static_cast<int>(i) + 1] = names->GetValue(i);
    if (auto* unit = vtkStringArray::SafeDownCast(fields->GetAbstractArray("Units")))
        if (unit->GetNumberOfValues() == 1) raw.unit = stated_unit("UNITS=" + unit->GetValue(0));
}

void read_attributes(vtkPolyData* data, RawSurface& raw) {
    vtkPointData* arrays = data->GetPointData();
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i) {
        vtkDataArray* array = arrays->GetArray(i);
        const char* name = arrays->GetArrayName(i);
        if (!array || !name || array->GetNumberOfComponents() != 1 ||
            array->GetNumberOfTuples() != data->GetNumberOfPoints()) {
            raw.notes.push_back("the point array '" + std::string(name ? name : "") +
                                "' was ignored (only arrays with one number per point are kept)");
            continue;
        }
        auto& values = raw.attributes[name];
        values.resize(raw.positions.size());
        for (std::size_t v = 0; v < values.size(); ++v)
            values[v] = array->GetComponent(static_cast<vtkIdType>(v), 0);
    }
}

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
    if (data->GetCellData()->HasArray(kSimVascularFaces) != 0)
        raw.usual_unit = LengthUnit::Centimetre;
    read_names(data, raw);
    read_attributes(data, raw);
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
