#include "geometry/formats/centerline_file.h"

#include <algorithm>
#include <filesystem>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>

#include "geometry/formats/vtk_xml.h"
#include "geometry/formats/vtk_xml_check.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {
namespace {

/// Line ends closer than this fraction of the extent are merged into one node.
constexpr double kSamePlace = 1e-6;

template <class Array>
vtkSmartPointer<Array> named(const char* name) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    return array;
}

void add_points(const CenterlineGraph& graph, vtkPolyData* lines) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    const auto radii = named<vtkDoubleArray>("MaximumInscribedSphereRadius");
    const auto along = named<vtkDoubleArray>("Abscissas");
    const auto ids = named<vtkIntArray>("BranchId");
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const CenterlineBranch& branch = graph.branches[b];
        const auto s = abscissas(branch);
        cells->InsertNextCell(static_cast<vtkIdType>(branch.points.size()));
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            cells->InsertCellPoint(points->InsertNextPoint(branch.points[i].data()));
            radii->InsertNextValue(branch.radii[i]);
            along->InsertNextValue(s[i]);
            ids->InsertNextValue(static_cast<int>(b));
        }
    }
    lines->SetPoints(points);
    lines->SetLines(cells);
    lines->GetPointData()->AddArray(radii);
    lines->GetPointData()->AddArray(along);
    lines->GetPointData()->AddArray(ids);
}

void add_cells(const CenterlineGraph& graph, vtkPolyData* lines) {
    const auto add = [&](const char* name, auto&& value) {
        const auto array = named<vtkIntArray>(name);
        for (std::size_t b = 0; b < graph.branches.size(); ++b) {
            array->InsertNextValue(static_cast<int>(value(b)));
        }
        lines->GetCellData()->AddArray(array);
    };
    add("CenterlineIds", [](std::size_t b) { return b; });
    add("TractIds", [](std::size_t) { return 0; });
    add("GroupIds", [](std::size_t b) { return b; });
    add("Blanking", [](std::size_t) { return 0; });
    add("StartNodeIds", [&](std::size_t b) { return graph.branches[b].start_node; });
    add("EndNodeIds", [&](std::size_t b) { return graph.branches[b].end_node; });
    const auto length = named<vtkDoubleArray>("Length");
    for (const auto& branch : graph.branches) length->InsertNextValue(branch_length(branch));
    lines->GetCellData()->AddArray(length);
}

/// An array with a value for each of `count` points or cells; null: none.
vtkDataArray* complete_array(vtkDataSetAttributes* arrays, const char* name, vtkIdType count) {
    vtkDataArray* array = arrays->GetArray(name);
    const bool complete = array != nullptr && array->GetNumberOfComponents() == 1 &&
                          array->GetNumberOfTuples() >= count;
    return complete ? array : nullptr;
}

/// A point of the file, which may refer to points that it lacks.
Vec3 checked_point(vtkPolyData* data, vtkIdType id, const std::string& name) {
    if (data->GetPoints() == nullptr || id < 0 || id >= data->GetNumberOfPoints())
        throw InvalidInput(name + " is damaged: a line refers to a missing point");
    Vec3 p;
    data->GetPoint(id, p.data());
    if (!p.allFinite())
        throw InvalidInput(name + " is damaged: point " + std::to_string(id) + " is not finite");
    return p;
}

std::vector<CenterlineBranch> lines_of(vtkPolyData* data, const std::string& name) {
    const vtkIdType points = data->GetNumberOfPoints();
    auto* radii = complete_array(data->GetPointData(), "MaximumInscribedSphereRadius", points);
    if (radii == nullptr) radii = complete_array(data->GetPointData(), "Radius", points);
    std::vector<CenterlineBranch> branches;
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    for (data->GetLines()->InitTraversal(); data->GetLines()->GetNextCell(count, ids) != 0;) {
        CenterlineBranch branch;
        for (vtkIdType i = 0; i < count; ++i) {
            branch.points.push_back(checked_point(data, ids[i], name));
            branch.radii.push_back(radii != nullptr ? radii->GetTuple1(ids[i]) : 0.0);
        }
        branches.push_back(std::move(branch));
    }
    return branches;
}

std::size_t node_at(const Vec3& place, double radius, double tolerance, CenterlineGraph& graph) {
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if ((graph.nodes[n].position - place).norm() <= tolerance) return n;
    }
    graph.nodes.push_back({place, radius, {}});
    return graph.nodes.size() - 1;
}

/// Node numbers of the lines' ends from the file; false if they are missing or invalid.
bool numbered_nodes(vtkPolyData* data, CenterlineGraph& graph) {
    const vtkIdType first = data->GetNumberOfVerts();
    const vtkIdType cells = first + static_cast<vtkIdType>(graph.branches.size());
    auto* starts = complete_array(data->GetCellData(), "StartNodeIds", cells);
    auto* ends = complete_array(data->GetCellData(), "EndNodeIds", cells);
    if (starts == nullptr || ends == nullptr) return false;
    const double most = 2.0 * static_cast<double>(graph.branches.size());
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        CenterlineBranch& branch = graph.branches[b];
        const double from = starts->GetTuple1(first + static_cast<vtkIdType>(b));
        const double to = ends->GetTuple1(first + static_cast<vtkIdType>(b));
        if (!(from >= 0.0 && from < most && to >= 0.0 && to < most)) return false;
        branch.start_node = static_cast<std::size_t>(from);
        branch.end_node = static_cast<std::size_t>(to);
    }
    for (const CenterlineBranch& branch : graph.branches) {
        graph.nodes.resize(
            std::max({graph.nodes.size(), branch.start_node + 1, branch.end_node + 1}));
        graph.nodes[branch.start_node].position = branch.points.front();
        graph.nodes[branch.start_node].radius = branch.radii.front();
        graph.nodes[branch.end_node].position = branch.points.back();
        graph.nodes[branch.end_node].radius = branch.radii.back();
    }
    return true;
}

void find_nodes(vtkPolyData* data, CenterlineGraph& graph) {
    if (!numbered_nodes(data, graph)) {
        const double tolerance = kSamePlace * data->GetLength();
        graph.nodes.clear();
        for (CenterlineBranch& b : graph.branches) {
            b.start_node = node_at(b.points.front(), b.radii.front(), tolerance, graph);
            b.end_node = node_at(b.points.back(), b.radii.back(), tolerance, graph);
        }
    }
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        graph.nodes[graph.branches[b].start_node].branches.push_back(b);
        graph.nodes[graph.branches[b].end_node].branches.push_back(b);
    }
}

}  // namespace

const Format& centerline_format() {
    static const Format row = {.name = "VTP",
                               .kind = FormatKind::Centerlines,
                               .suffixes = {".vtp"},
                               .content = "a polyline per branch, with radii"};
    return row;
}

void check_centerline_name(const std::string& path) {
    if (is_named_for_writing(centerline_format(), path)) return;
    throw UsageError("OUT '" + bare_name(path) + "' does not end in " +
                     centerline_format().suffixes[0]);
}

void write_centerlines(const CenterlineGraph& graph, const std::string& path) {
    check_centerline_name(path);
    if (graph.branches.empty()) throw InvalidInput("there is no centerline to write");
    vtkNew<vtkPolyData> lines;
    add_points(graph, lines);
    add_cells(graph, lines);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(lines);
    writer->SetWriteToOutputString(true);
    writer->SetHeaderTypeToUInt64();
    if (writer->Write() == 0) throw IoError("the centerlines could not be encoded as VTP");
    const std::string text = writer->GetOutputString();
    write_file(path, text);
}

CenterlineGraph read_centerlines(const std::string& path) {
    const std::string name = bare_name(path);
    require_vtk_xml(file_content(path), name);
    const vtkSmartPointer<vtkPolyData> data = read_poly_data(path);
    CenterlineGraph graph;
    graph.branches = lines_of(data, name);
    for (const CenterlineBranch& b : graph.branches) {
        if (b.points.size() < 2)
            throw InvalidInput(name + " has a line with fewer than two points");
    }
    if (graph.branches.empty()) throw InvalidInput(name + " contains no lines");
    find_nodes(data, graph);
    return graph;
}

}  // namespace vesselbench
