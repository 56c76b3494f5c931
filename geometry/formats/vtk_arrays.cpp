#include "geometry/formats/vtk_arrays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkStringArray.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

void read_names(vtkPointSet* data, RawSurface& raw) {
    vtkFieldData* fields = data->GetFieldData();
    if (auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("PatchNames")))
        for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
            raw.part_names[static_cast<int>(i) + 1] = names->GetValue(i);
    if (auto* unit = vtkStringArray::SafeDownCast(fields->GetAbstractArray("Units")))
        if (unit->GetNumberOfValues() == 1) raw.unit = unit_named(unit->GetValue(0));
    if (auto* space = vtkStringArray::SafeDownCast(fields->GetAbstractArray("SPACE")))
        if (space->GetNumberOfValues() == 1) raw.axes = axes_named(space->GetValue(0));
}

void read_attributes(vtkPointSet* data, RawSurface& raw) {
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

}  // namespace

RawSurface points_of(vtkPointSet* data, const std::string& file) {
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

vtkDataArray* part_array(vtkPointSet* data) {
    for (const char* name : {"CellEntityIds", kSimVascularFaces})
        if (vtkDataArray* found = data->GetCellData()->GetArray(name))
            if (found->GetNumberOfComponents() == 1 &&
                found->GetNumberOfTuples() == data->GetNumberOfCells())
                return found;
    return nullptr;
}

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

void read_arrays(vtkPointSet* data, RawSurface& raw) {
    if (data->GetCellData()->HasArray(kSimVascularFaces) != 0)
        raw.usual_unit = LengthUnit::Centimetre;
    read_names(data, raw);
    read_attributes(data, raw);
}

}  // namespace vesselbench
