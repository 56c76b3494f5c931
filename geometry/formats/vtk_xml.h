#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

/// Collects the XML part and the appended binary blocks of a VTK file.
class VtkXml {
public:
    template <class T>
    void array(const std::string& name, const char* type, int components,
               const std::vector<T>& values) {
        xml_ += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + xml_escaped(name) +
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
    std::string xml_, data_;
};

/// x, y, z of every point, one after the other.
inline std::vector<double> flat_coordinates(const Positions& points) {
    std::vector<double> values;
    values.reserve(3 * points.size());
    for (const Vec3& p : points) values.insert(values.end(), p.data(), p.data() + 3);
    return values;
}

}  // namespace vesselbench
