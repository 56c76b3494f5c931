#include <array>
#include <bit>
#include <cstdint>

#include "geometry/io/atomic_file.h"
#include "geometry/io/vtk_surface.h"

namespace vesselbench {

namespace {

/// Collects the XML part and the appended binary blocks of a VTK file.
class VtkXml {
public:
    template <class T>
    void array(const std::string& name, const char* type, int components,
               const std::vector<T>& values) {
        xml_ += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + escaped(name) +
                "\" NumberOfComponents=\"" + std::to_string(components) +
                "\" format=\"appended\" offset=\"" + std::to_string(data_.size()) + "\"/>\n";
        const std::uint64_t bytes = values.size() * sizeof(T);
        const auto head = std::bit_cast<std::array<char, 8>>(bytes);
        data_.append(head.data(), head.size());
        data_.append(reinterpret_cast<const char*>(values.data()), bytes);
    }

    /// VTK stores texts as character codes, each text ended by 0.
    void texts(const std::string& name, const std::vector<std::string>& values) {
        xml_ += "<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" +
                std::to_string(values.size()) + "\" format=\"ascii\">";
        for (const std::string& value : values) {
            for (const char c : value)
                xml_ += std::to_string(static_cast<int>(static_cast<unsigned char>(c))) + " ";
            xml_ += "0 ";
        }
        xml_ += "</Array>\n";
    }

    void tag(const std::string& text) { xml_ += text + "\n"; }

    void write(std::ostream& out) const {
        out << xml_ << "<AppendedData encoding=\"raw\">\n_";
        out.write(data_.data(), static_cast<std::streamsize>(data_.size()));
        out << "\n</AppendedData>\n</VTKFile>\n";
    }

private:
    static std::string escaped(const std::string& text) {
        std::string safe;
        for (const char c : text)
            safe += c == '&'   ? "&amp;"
                    : c == '<' ? "&lt;"
                    : c == '"' ? "&quot;"
                               : std::string(1, c);
        return safe;
    }

    std::string xml_, data_;
};

std::vector<double> flat(const Positions& points) {
    std::vector<double> values;
    values.reserve(3 * points.size());
    for (const Vec3& p : points) values.insert(values.end(), p.data(), p.data() + 3);
    return values;
}

}  // namespace

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
    xml.array("Points", "Float64", 3, flat(surface.points()));
    xml.tag("</Points>\n<Polys>");
    xml.array("connectivity", "Int64", 1, corners);
    xml.array("offsets", "Int64", 1, offsets);
    xml.tag("</Polys>\n</Piece>\n</PolyData>");
    write_file(path, [&](std::ostream& out) { xml.write(out); });
}

}  // namespace vesselbench
