#include "geometry/formats/vtk_mesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

/// A VTK array that views our values; VTK's writers do not change them.
template <class Array, class T>
vtkSmartPointer<Array> view_of(const T* values, std::size_t count) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetArray(const_cast<T*>(values), static_cast<vtkIdType>(count), 1);
    return array;
}

void add_cell_values(vtkDataSet* data, const VtkMesh& mesh) {
    for (const auto& [name, values] : mesh.cell_values) {
        const auto array = view_of<vtkDoubleArray>(values->data(), values->size());
        array->SetNumberOfComponents(static_cast<int>(values->size() / mesh.regions.size()));
        array->SetName(name.c_str());
        data->GetCellData()->AddArray(array);
    }
}

vtkSmartPointer<vtkCellArray> cells_of(const VtkMesh& mesh) {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    const auto offsets = view_of<vtkTypeInt64Array>(mesh.offsets.data(), mesh.offsets.size());
    const auto corners = view_of<vtkTypeInt64Array>(mesh.corners.data(), mesh.corners.size());
    cells->SetData(offsets.Get(), corners.Get());
    return cells;
}

void add_texts(vtkDataSet* data, const char* name, const std::vector<std::string>& texts) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& text : texts) array->InsertNextValue(text);
    data->GetFieldData()->AddArray(array);
}

/// All but the cells.
void fill(vtkPointSet* data, const VtkMesh& mesh) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const auto xyz = view_of<vtkDoubleArray>(reinterpret_cast<const double*>(mesh.points.data()),
                                             3 * mesh.points.size());
    xyz->SetNumberOfComponents(3);
    vtkNew<vtkPoints> points;
    points->SetData(xyz);
    data->SetPoints(points);
    for (const auto& [name, values] : mesh.attributes) {
        const auto array = view_of<vtkDoubleArray>(values->data(), values->size());
        array->SetName(name.c_str());
        data->GetPointData()->AddArray(array);
    }
    const auto regions = view_of<vtkIntArray>(mesh.regions.data(), mesh.regions.size());
    regions->SetName("CellEntityIds");
    data->GetCellData()->SetScalars(regions);
    add_cell_values(data, mesh);
    add_texts(data, "PatchNames", mesh.patch_names);
    add_texts(data, "Units", {"mm"});
    if (!mesh.provenance.empty()) add_texts(data, "Provenance", {comment_line(mesh.provenance)});
}

template <class Writer>
void write_with(vtkDataSet* data, const std::string& path, const Progress& progress) {
    progress.report(0.0, writing_text(path));
    PendingFiles files;
    const std::string temporary = files.add(path).string();
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetFileName(temporary.c_str());
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->SetHeaderTypeToUInt64();
    if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
        throw IoError("'" + bare_name(path) + "' cannot be written: " +
                      vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
    progress.check_cancelled();  // VTK writes 100 MB in a tenth of a second, and hears no abort
    files.commit();
}

}  // namespace

void write_vtk_poly_data(const VtkMesh& mesh, const std::string& path, const Progress& progress) {
    vtkNew<vtkPolyData> data;
    fill(data, mesh);
    data->SetPolys(cells_of(mesh));
    write_with<vtkXMLPolyDataWriter>(data, path, progress);
}

void write_vtk_unstructured_grid(const VtkMesh& mesh, const std::string& path,
                                 const Progress& progress) {
    vtkNew<vtkUnstructuredGrid> data;
    fill(data, mesh);
    const auto types = view_of<vtkUnsignedCharArray>(mesh.types.data(), mesh.types.size());
    data->SetCells(types.Get(), cells_of(mesh).Get());
    write_with<vtkXMLUnstructuredGridWriter>(data, path, progress);
}

}  // namespace vesselbench
