#include "geometry/formats/vtk_xml.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

/// Records VTK's complaints instead of letting it print them.
class Complaint : public vtkCommand {
public:
    static Complaint* New() { return new Complaint; }

    void Execute(vtkObject*, unsigned long, void*) override { raised = true; }

    bool raised = false;
};

/// \param what the file should hold
template <class Reader, class Data>
vtkSmartPointer<Data> read_with(const std::string& path, const char* what) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkNew<Reader> reader;
    vtkNew<Complaint> complaint;
    reader->AddObserver(vtkCommand::ErrorEvent, complaint.Get());
    reader->AddObserver(vtkCommand::WarningEvent, complaint.Get());
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkSmartPointer<Data> data = reader->GetOutput();
    if (complaint->raised || reader->GetErrorCode() != vtkErrorCode::NoError || !data)
        throw InvalidInput(bare_name(path) + " is damaged, truncated, or not a VTK " + what +
                           ": VTK cannot read it");
    return data;
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_poly_data(const std::string& path) {
    return read_with<vtkXMLPolyDataReader, vtkPolyData>(path, "surface (poly data)");
}

vtkSmartPointer<vtkUnstructuredGrid> read_unstructured_grid(const std::string& path) {
    return read_with<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(path, "unstructured grid");
}

}  // namespace vesselbench
