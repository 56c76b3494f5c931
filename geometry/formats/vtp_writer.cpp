#include <cstdint>

#include "geometry/formats/vtk_xml.h"
#include "geometry/formats/vtp.h"
#include "geometry/formats/whole_file.h"

namespace vesselbench {

void write_vtp(const Surface& surface, const std::string& path) {
    std::vector<std::int64_t> corners, offsets;
    std::vector<std::int32_t> parts;
    std::vector<std::string> names;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        for (const VertexId v : surface.triangles()[t]) corners.push_back(v);
        offsets.push_back(3 * (static_cast<std::int64_t>(t) + 1));
        parts.push_back((*surface.patch_labels)[t] + 1);
    }
    for (const Patch& patch : surface.patches) names.push_back(patch.name);
    VtkXml xml;
    xml.tag("<?xml version=\"1.0\"?>");
    xml.tag(
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n<FieldData>");
    xml.texts("PatchNames", names);
    xml.texts("Units", {"mm"});
    xml.tag("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(surface.vertex_count()) +
            "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
            std::to_string(surface.triangle_count()) + "\">\n<PointData>");
    for (const auto& [name, values] : surface.attributes) xml.array(name, "Float64", 1, *values);
    xml.tag("</PointData>\n<CellData Scalars=\"CellEntityIds\">");
    xml.array("CellEntityIds", "Int32", 1, parts);
    xml.tag("</CellData>\n<Points>");
    xml.array("Points", "Float64", 3, flat_coordinates(surface.points()));
    xml.tag("</Points>\n<Polys>");
    xml.array("connectivity", "Int64", 1, corners);
    xml.array("offsets", "Int64", 1, offsets);
    xml.tag("</Polys>\n</Piece>\n</PolyData>");
    write_file(path, [&](std::ostream& out) { xml.write(out); });
}

}  // namespace vesselbench
