#include "meshing/products/vtu.h"

#include <cstdint>

#include "geometry/formats/vtk_xml.h"
#include "geometry/formats/whole_file.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::uint8_t kVtkTriangle = 5, kVtkTetra = 10;

struct VtkCells {
    std::vector<std::int64_t> corners, offsets;
    std::vector<std::uint8_t> types;
    std::vector<std::int32_t> regions;

    template <class Corners>
    void add(const Corners& cell, std::uint8_t type, std::int32_t region) {
        corners.insert(corners.end(), cell.begin(), cell.end());
        offsets.push_back(static_cast<std::int64_t>(corners.size()));
        types.push_back(type);
        regions.push_back(region);
    }
};

VtkCells cells_of(const VolumeMesh& mesh) {
    VtkCells cells;
    for (const Tetrahedron& cell : mesh.tetrahedra) cells.add(cell, kVtkTetra, 0);
    for (std::size_t t = 0; t < mesh.boundary.size(); ++t)
        cells.add(mesh.boundary[t], kVtkTriangle, mesh.boundary_patches[t] + 1);
    return cells;
}

}  // namespace

void write_vtu(const VolumeMesh& mesh, const std::string& path) {
    if (mesh.tetrahedra.empty()) throw InvalidInput("VTU: the volume mesh has no cells");
    const VtkCells cells = cells_of(mesh);
    std::vector<std::string> names;
    for (const Patch& patch : mesh.patches) names.push_back(patch.name);
    VtkXml xml;
    xml.tag("<?xml version=\"1.0\"?>");
    xml.tag(
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">");
    xml.tag("<UnstructuredGrid>\n<FieldData>");
    xml.texts("PatchNames", names);
    xml.texts("Units", {"mm"});
    xml.tag("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) +
            "\" NumberOfCells=\"" + std::to_string(cells.types.size()) + "\">");
    xml.tag("<CellData Scalars=\"CellEntityIds\">");
    xml.array("CellEntityIds", "Int32", 1, cells.regions);
    xml.tag("</CellData>\n<Points>");
    xml.array("Points", "Float64", 3, flat_coordinates(mesh.points));
    xml.tag("</Points>\n<Cells>");
    xml.array("connectivity", "Int64", 1, cells.corners);
    xml.array("offsets", "Int64", 1, cells.offsets);
    xml.array("types", "UInt8", 1, cells.types);
    xml.tag("</Cells>\n</Piece>\n</UnstructuredGrid>");
    write_file(path, [&](std::ostream& out) { xml.write(out); });
}

}  // namespace vesselbench
