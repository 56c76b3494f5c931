#include "geometry/formats/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

static_assert(std::endian::native == std::endian::little);

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

constexpr std::pair<const char*, Type> kTypes[] = {
    {"char", Type::Int8},      {"int8", Type::Int8},       {"uchar", Type::Uint8},
    {"uint8", Type::Uint8},    {"short", Type::Int16},     {"int16", Type::Int16},
    {"ushort", Type::Uint16},  {"uint16", Type::Uint16},   {"int", Type::Int32},
    {"int32", Type::Int32},    {"uint", Type::Uint32},     {"uint32", Type::Uint32},
    {"float", Type::Float32},  {"float32", Type::Float32}, {"double", Type::Float64},
    {"float64", Type::Float64}};

constexpr const char* kIgnored[] = {"nx", "ny", "nz", "red", "green",     "blue",     "alpha",
                                    "s",  "t",  "u",  "v",   "texture_u", "texture_v"};

struct Property {
    std::string name;
    Type type = Type::Float32;
    std::optional<Type> count_type;  ///< of a list
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Encoding { Text, LittleEndian, BigEndian };

struct Header {
    Encoding encoding = Encoding::Text;
    std::vector<Element> elements;
    std::size_t size = 0;   ///< bytes
    std::size_t lines = 0;  ///< of the header
    std::optional<LengthUnit> unit;
    std::optional<PatientAxes> axes;
    std::map<int, std::string> part_names;
};

Type type_of(TextScanner& scan) {
    const std::string_view word = scan.word();
    for (const auto& [name, type] : kTypes)
        if (word == name) return type;
    scan.fail("'" + std::string(word.substr(0, 40)) + "' is not a PLY type");
}

void read_comment(TextScanner& scan, Header& header) {
    if (const auto unit = stated_unit(scan.whole_line())) header.unit = unit;
    if (const auto axes = stated_axes(scan.whole_line())) header.axes = axes;
    if (scan.word() != "patch") return;
    const std::string id(scan.word()), name(scan.word());
    if (!name.empty()) header.part_names[static_cast<int>(scan.parse_integer(id, "patch"))] = name;
}

Encoding encoding_of(TextScanner& scan) {
    const std::string_view word = scan.word();
    if (word == "ascii") return Encoding::Text;
    if (word == "binary_little_endian") return Encoding::LittleEndian;
    if (word == "binary_big_endian") return Encoding::BigEndian;
    scan.fail("'" + std::string(word.substr(0, 40)) + "' is not a PLY format");
}

void read_property(TextScanner& scan, Header& header) {
    if (header.elements.empty()) scan.fail("a property comes before the first element");
    Property property;
    const std::string_view rest = scan.whole_line();
    if (rest.find(" list ") != std::string_view::npos) {
        scan.word();
        property.count_type = type_of(scan);
        if (*property.count_type == Type::Float32 || *property.count_type == Type::Float64)
            scan.fail("the length of a list cannot be a real number");
    }
    property.type = type_of(scan);
    property.name = std::string(scan.word());
    if (property.name.empty()) scan.fail("a property without a name");
    header.elements.back().properties.push_back(std::move(property));
}

Header read_header(const std::string& bytes, const std::string& file) {
    TextScanner scan(bytes, file);
    Header header;
    if (!scan.next_line('\0') || scan.word() != "ply") scan.fail("the first word is not 'ply'");
    bool has_format = false;
    while (scan.next_line('\0')) {
        const std::string_view word = scan.word();
        if (word == "format") {
            header.encoding = encoding_of(scan);
            has_format = true;
        } else if (word == "comment") {
            read_comment(scan, header);
        } else if (word == "element") {
            const std::string name(scan.word());
            const long long count = scan.integer("number of elements");
            if (name.empty() || count < 0) scan.fail("an element without a name or count");
            header.elements.push_back({name, static_cast<std::size_t>(count), {}});
        } else if (word == "property") {
            read_property(scan, header);
        } else if (word == "end_header") {
            if (!has_format) scan.fail("the header states no format");
            header.size = static_cast<std::size_t>(scan.whole_line().data() - bytes.data()) +
                          scan.whole_line().size();
            header.size = std::min(bytes.find('\n', header.size), bytes.size() - 1) + 1;
            header.lines = scan.line();
            return header;
        } else if (word != "obj_info") {
            scan.fail("'" + std::string(word.substr(0, 40)) + "' does not belong in a PLY header");
        }
    }
    scan.fail("the header has no end: the file is truncated or not a PLY file");
}

/// The values of the body, one after the other, in any encoding.
class Body {
public:
    Body(const std::string& bytes, const std::string& file, const Header& header)
        : bytes_(bytes), file_(file), encoding_(header.encoding), at_(header.size) {}

    double number(Type type, const char* what) {
        return encoding_ == Encoding::Text ? text_number(what) : binary_number(type, what);
    }

    /// A value that must be an integer from 0 to `limit`.
    std::size_t index(Type type, std::size_t limit, const char* what) {
        const double value = number(type, what);
        if (!(value >= 0.0 && value <= static_cast<double>(limit)) || value != std::floor(value))
            fail(std::string("the ") + what + " is " + std::to_string(value) +
                 ", allowed are 0 to " + std::to_string(limit) + ": the file is damaged");
        return static_cast<std::size_t>(value);
    }

    /// Smallest number of bytes for `count` further values.
    [[nodiscard]] std::size_t bytes_left() const { return bytes_.size() - at_; }

    [[noreturn]] void fail(const std::string& what) const {
        throw InvalidInput(file_ + ", byte " + std::to_string(at_) + ": " + what);
    }

private:
    double text_number(const char* what) {
        at_ = std::min(bytes_.find_first_not_of(" \t\r\n\v\f", at_), bytes_.size());
        if (at_ == bytes_.size()) cut_off(what);
        const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n\v\f", at_), bytes_.size());
        const TextScanner parser({}, file_ + ", byte " + std::to_string(at_));
        double value = 0.0;
        const std::string_view word(bytes_.data() + at_, end - at_);
        if (const auto quick = plain_number(word))
            value = *quick;
        else
            value = parser.parse_number(word, what);
        at_ = end;
        return value;
    }

    static std::optional<double> plain_number(std::string_view word);

    template <class T>
    double take() {
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
        if (encoding_ == Encoding::BigEndian) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return static_cast<double>(std::bit_cast<T>(raw));
    }

    double binary_number(Type type, const char* what) {
        constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
        if (bytes_left() < sizes[static_cast<int>(type)]) cut_off(what);
        switch (type) {
            case Type::Int8:
                return take<std::int8_t>();
            case Type::Uint8:
                return take<std::uint8_t>();
            case Type::Int16:
                return take<std::int16_t>();
            case Type::Uint16:
                return take<std::uint16_t>();
            case Type::Int32:
                return take<std::int32_t>();
            case Type::Uint32:
                return take<std::uint32_t>();
            case Type::Float32:
                return take<float>();
            default:
                return take<double>();
        }
    }

    [[noreturn]] void cut_off(const char* what) const {
        fail(std::string("the file ends where a value is expected (") + what +
             "): it is truncated; copy or download it again");
    }

    const std::string& bytes_;
    const std::string& file_;
    Encoding encoding_;
    std::size_t at_;
};

std::optional<double> Body::plain_number(std::string_view word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

class Reader {
public:
    Reader(const std::string& bytes, const std::string& file)
        : file_(file), header_(read_header(bytes, file)), body_(bytes, file, header_) {}

    RawSurface read() {
        raw_.unit = header_.unit;
        raw_.axes = header_.axes;
        raw_.part_names = header_.part_names;
        for (const Element& element : header_.elements) {
            if (element.properties.empty() && element.count > 0)
                body_.fail("the '" + element.name + "' elements have no properties");
            // Every element takes at least one byte: a larger count means a damaged header.
            if (element.count > body_.bytes_left())
                body_.fail("the header announces " + std::to_string(element.count) + " '" +
                           element.name +
                           "' elements, more than the file can hold: it is truncated or damaged");
            if (element.name == "vertex")
                read_points(element);
            else if (element.name == "face")
                read_faces(element);
            else
                for (std::size_t i = 0; i < element.count; ++i)
                    for (const Property& property : element.properties) skip(property);
        }
        return std::move(raw_);
    }

private:
    void skip(const Property& property) {
        std::size_t count = 1;
        if (property.count_type)
            count = body_.index(*property.count_type, body_.bytes_left(), "list length");
        for (std::size_t i = 0; i < count; ++i) body_.number(property.type, "skipped value");
    }

    void read_points(const Element& element) {
        const auto& properties = element.properties;
        std::array<std::size_t, 3> axes{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string name(1, static_cast<char>('x' + k));
            const auto found =
                std::find_if(properties.begin(), properties.end(),
                             [&](const auto& p) { return p.name == name && !p.count_type; });
            if (found == properties.end()) body_.fail("the points have no property " + name);
            axes[k] = static_cast<std::size_t>(found - properties.begin());
        }
        std::vector<std::vector<double>*> kept(properties.size(), nullptr);
        for (std::size_t i = 0; i < properties.size(); ++i) {
            const bool ignored = std::find(std::begin(kIgnored), std::end(kIgnored),
                                           properties[i].name) != std::end(kIgnored);
            const bool axis = std::find(axes.begin(), axes.end(), i) != axes.end();
            if (!ignored && !axis && !properties[i].count_type)
                kept[i] = &raw_.attributes[properties[i].name];
        }
        std::vector<double> values(properties.size());
        for (std::size_t v = 0; v < element.count; ++v) {
            for (std::size_t i = 0; i < properties.size(); ++i) {
                if (properties[i].count_type) {
                    skip(properties[i]);
                    continue;
                }
                values[i] = body_.number(properties[i].type, "point");
                if (kept[i]) kept[i]->push_back(values[i]);
            }
            const Vec3 p(values[axes[0]], values[axes[1]], values[axes[2]]);
            if (!p.allFinite())
                body_.fail(
                    "a coordinate of point " + std::to_string(v) +
                    " is not finite; the program that wrote the file failed; export it again");
            raw_.positions.push_back(p);
        }
    }

    void read_faces(const Element& element) {
        std::vector<VertexId> polygon;
        for (std::size_t f = 0; f < element.count; ++f) {
            std::optional<int> part;
            polygon.clear();
            for (const Property& property : element.properties) {
                const bool corners = property.count_type && (property.name == "vertex_indices" ||
                                                             property.name == "vertex_index");
                if (corners)
                    read_corners(property, polygon);
                else if (property.name == "CellEntityIds" && !property.count_type)
                    part = static_cast<int>(body_.index(property.type, 1000000, "CellEntityIds"));
                else
                    skip(property);
            }
            if (polygon.empty())
                body_.fail("face " + std::to_string(f) + " has no corners (vertex_indices)");
            append_polygon(raw_.positions, polygon, raw_.triangles);
            if (part) raw_.part_ids.resize(raw_.triangles.size(), *part);
        }
    }

    void read_corners(const Property& property, std::vector<VertexId>& polygon) {
        const std::size_t count =
            body_.index(*property.count_type, raw_.positions.size(), "number of corners");
        if (count < 3) body_.fail("a face with " + std::to_string(count) + " corners");
        for (std::size_t k = 0; k < count; ++k)
            polygon.push_back(static_cast<VertexId>(
                body_.index(property.type, raw_.positions.size() - 1, "face corner")));
    }

    std::string file_;
    Header header_;
    Body body_;
    RawSurface raw_;
};

template <class T>
void put(std::string& bytes, T value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes.append(raw.data(), raw.size());
}

}  // namespace

RawSurface read_ply(const std::string& path) {
    const std::string bytes = file_content(path);
    return Reader(bytes, bare_name(path)).read();
}

void write_ply(const Surface& surface, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    require_plain_names(surface.patches);
    for (const auto& [name, values] : surface.attributes) require_plain_name(name, "an attribute");
    std::string bytes = "ply\nformat binary_little_endian 1.0\n";
    bytes += "comment surface of vesselbench UNITS=mm\n";
    if (!provenance.empty()) bytes += "comment " + comment_line(provenance) + "\n";
    for (std::size_t i = 0; i < surface.patches.size(); ++i)
        bytes += "comment patch " + std::to_string(i + 1) + " " + surface.patches[i].name + "\n";
    bytes += "element vertex " + std::to_string(surface.vertex_count()) + "\n";
    for (const char* axis : {"x", "y", "z"}) bytes += std::string("property double ") + axis + "\n";
    for (const auto& [name, values] : surface.attributes) bytes += "property double " + name + "\n";
    bytes += "element face " + std::to_string(surface.triangle_count()) +
             "\nproperty list uchar int vertex_indices\nproperty int CellEntityIds\nend_header\n";
    LoopProgress rows(progress, surface.vertex_count() + surface.triangle_count(),
                      writing_text(path));
    for (VertexId v = 0; v < surface.vertex_count(); ++v) {
        rows.step();
        for (int k = 0; k < 3; ++k) put(bytes, surface.points()[v][k]);
        for (const auto& [name, values] : surface.attributes) put(bytes, (*values)[v]);
    }
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        rows.step();
        put(bytes, std::uint8_t{3});
        for (const VertexId v : surface.triangles()[t]) put(bytes, static_cast<std::int32_t>(v));
        put(bytes, static_cast<std::int32_t>((*surface.patch_labels)[t] + 1));
    }
    write_file(path, bytes, progress);
}

}  // namespace vesselbench
