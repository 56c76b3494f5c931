#include "geometry/formats/openfoam_fields.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkLogger.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

constexpr double kMillimetresInMetre = 1000.0;

/// The first surface of this name among the blocks of a data set and those below them.
vtkPolyData* patch_block(vtkMultiBlockDataSet* blocks, const std::string& name) {
    for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i) {
        vtkDataObject* block = blocks->GetBlock(i);
        if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(block))
            if (vtkPolyData* found = patch_block(inner, name)) return found;
        auto* surface = vtkPolyData::SafeDownCast(block);
        if (surface == nullptr || blocks->HasMetaData(i) == 0) continue;
        const char* own = blocks->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
        if (own != nullptr && name == own) return surface;
    }
    return nullptr;
}

/// The triangles, and for each of them the face that it is of.
std::vector<vtkIdType> take_faces(vtkPolyData* surface, FoamPatchFields& patch) {
    for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p) {
        double point[3];
        surface->GetPoint(p, point);
        patch.points.push_back(kMillimetresInMetre * Vec3(point[0], point[1], point[2]));
    }
    std::vector<vtkIdType> face_of;
    vtkNew<vtkIdList> ids;
    for (vtkIdType face = 0; face < surface->GetPolys()->GetNumberOfCells(); ++face) {
        surface->GetPolys()->GetCellAtId(face, ids);
        std::vector<VertexId> corners;
        for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
            corners.push_back(static_cast<VertexId>(ids->GetId(k)));
        append_polygon(patch.points, corners, patch.triangles);
        face_of.resize(patch.triangles.size(), face);
    }
    return face_of;
}

void take_field(vtkDataArray* values, const std::vector<vtkIdType>& face_of,
                FoamPatchFields& patch) {
    const std::string name = values->GetName();
    for (const vtkIdType face : face_of)
        if (values->GetNumberOfComponents() == 1) {
            patch.scalars[name].push_back(values->GetComponent(face, 0));
        } else if (values->GetNumberOfComponents() == 3) {
            double xyz[3];
            values->GetTuple(face, xyz);
            patch.vectors[name].emplace_back(xyz[0], xyz[1], xyz[2]);
        }
}

/// The reader with nothing but the patch to be read. VTK prints no complaint of its own.
vtkSmartPointer<vtkOpenFOAMReader> reader_of(const std::filesystem::path& folder,
                                             const std::string& patch) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    auto reader = vtkSmartPointer<vtkOpenFOAMReader>::New();
    reader->SetFileName((folder / "system" / "controlDict").c_str());
    reader->SkipZeroTimeOff();
    reader->UpdateInformation();
    reader->CreateCellToPointOff();
    reader->EnableAllCellArrays();
    reader->DisableAllPatchArrays();
    reader->SetPatchArrayStatus(("patch/" + patch).c_str(), 1);
    return reader;
}

}  // namespace

FoamPatchFields read_foam_patch(const std::filesystem::path& folder, const std::string& patch,
                                double time) {
    const std::string name = bare_name(folder);
    if (!std::filesystem::is_regular_file(folder / "system" / "controlDict"))
        throw IoError("'" + name + "' is not an OpenFOAM case: it has no system/controlDict");
    const auto reader = reader_of(folder, patch);
    if (reader->GetTimeValues() == nullptr || reader->GetTimeValues()->GetNumberOfTuples() == 0)
        throw InvalidInput("'" + name + "' has no time that VTK's OpenFOAM reader can read");
    reader->UpdateTimeStep(time);
    vtkPolyData* surface = patch_block(reader->GetOutput(), patch);
    if (surface == nullptr || surface->GetNumberOfPolys() == 0)
        throw InvalidInput("'" + name + "' has no patch " + patch +
                           " that VTK's OpenFOAM reader can read");
    FoamPatchFields fields;
    const std::vector<vtkIdType> face_of = take_faces(surface, fields);
    vtkCellData* values = surface->GetCellData();
    for (int k = 0; k < values->GetNumberOfArrays(); ++k) {
        vtkDataArray* array = values->GetArray(k);
        if (array == nullptr) continue;
        if (array->GetNumberOfTuples() != surface->GetNumberOfPolys())
            throw InvalidInput("'" + name + "': the field " + array->GetName() +
                               " is not of this mesh");
        take_field(array, face_of, fields);
    }
    return fields;
}

}  // namespace vesselbench
