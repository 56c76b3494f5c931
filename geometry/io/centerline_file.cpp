#include "geometry/io/centerline_file.h"

#include <functional>
#include <ostream>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "geometry/errors.h"
#include "geometry/io/atomic_file.h"

namespace vesselbench {

namespace {

void add_points(vtkPolyData* lines, const CenterlineGraph& graph) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkDoubleArray> radii, abscissas;
    radii->SetName("MaximumInscribedSphereRadius");
    abscissas->SetName("Abscissas");
    for (const CenterlineBranch& branch : graph.branches) {
        cells->InsertNextCell(static_cast<int>(branch.points.size()));
        double length = 0.0;
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            if (i > 0) length += (branch.points[i] - branch.points[i - 1]).norm();
            cells->InsertCellPoint(points->InsertNextPoint(branch.points[i].data()));
            radii->InsertNextValue(branch.radii[i]);
            abscissas->InsertNextValue(length);
        }
    }
    lines->SetPoints(points);
    lines->SetLines(cells);
    lines->GetPointData()->AddArray(radii);
    lines->GetPointData()->AddArray(abscissas);
}

void add_numbers(vtkPolyData* lines, const CenterlineGraph& graph, const char* name,
                 const std::function<std::size_t(std::size_t)>& number) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    for (std::size_t b = 0; b < graph.branches.size(); ++b)
        array->InsertNextValue(static_cast<int>(number(b)));
    lines->GetCellData()->AddArray(array);
}

}  // namespace

void write_centerlines(const CenterlineGraph& graph, const std::string& path) {
    if (!path.ends_with(".vtp"))
        throw UsageError("centerlines are written as .vtp, not '" +
                         path.substr(path.rfind('/') + 1) + "'");
    vtkNew<vtkPolyData> lines;
    add_points(lines, graph);
    add_numbers(lines, graph, "GroupIds", [](std::size_t b) { return b; });
    add_numbers(lines, graph, "CenterlineIds", [](std::size_t b) { return b; });
    add_numbers(lines, graph, "Blanking", [](std::size_t) { return 0; });
    add_numbers(lines, graph, "StartNodeIds",
                [&](std::size_t b) { return graph.branches[b].start_node; });
    add_numbers(lines, graph, "EndNodeIds",
                [&](std::size_t b) { return graph.branches[b].end_node; });
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(lines);
    writer->WriteToOutputStringOn();
    writer->SetDataModeToBinary();
    writer->SetCompressorTypeToNone();
    writer->Write();
    write_file(path, [&](std::ostream& out) { out << writer->GetOutputString(); });
}

}  // namespace vesselbench
