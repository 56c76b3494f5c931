#include "geometry/formats/nrrd.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/number_text.h"
#include "geometry/formats/slicer_segments.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

using Fields = std::map<std::string, std::string>;

struct Header {
    Fields fields;         ///< names in lower case without blanks: "spacedirections"
    NrrdPairs pairs;       ///< "key:=value"
    std::size_t data = 0;  ///< offset of the first byte after the header
};

Header parse_header(std::string_view bytes, const std::string& name) {
    if (bytes.substr(0, 4) != "NRRD")
        bad_file(name, "it does not start with NRRD", "check that it is an NRRD file");
    Header header;
    std::size_t at = 0;
    for (bool first = true;; first = false) {
        const auto end = bytes.find('\n', at);
        if (end == std::string_view::npos) {  // a detached header may end without a blank line
            header.data = bytes.size();
            if (!header.fields.contains("datafile"))
                bad_file(name, "it ends within its header", "copy or download the file again");
            return header;
        }
        const std::string_view line = trimmed(bytes.substr(at, end - at));
        at = end + 1;
        if (first || line.starts_with('#')) continue;
        if (line.empty()) {
            header.data = at;
            return header;
        }
        const auto colon = line.find(':');
        if (colon == std::string_view::npos)
            bad_file(name, "its header has a line that is not a field", "export the file again");
        if (line.substr(colon).starts_with(":=")) {
            header.pairs[std::string(line.substr(0, colon))] = trimmed(line.substr(colon + 2));
            continue;
        }
        std::string key = lower_case(line.substr(0, colon));
        std::erase(key, ' ');
        header.fields[key] = trimmed(line.substr(colon + 1));
    }
}

const std::string* find(const Fields& fields, const std::string& key) {
    const auto found = fields.find(key);
    return found == fields.end() ? nullptr : &found->second;
}

const std::string& needed(const Fields& fields, const std::string& key, const std::string& name) {
    if (const std::string* value = find(fields, key)) return *value;
    bad_file(name, "its header has no field '" + key + "'", "export the file again");
}

VoxelType voxel_type(const std::string& text, const std::string& name) {
    static const std::map<std::string, VoxelType> types = {
        {"signed char", VoxelType::Int8},
        {"int8", VoxelType::Int8},
        {"int8_t", VoxelType::Int8},
        {"uchar", VoxelType::UInt8},
        {"unsigned char", VoxelType::UInt8},
        {"uint8", VoxelType::UInt8},
        {"uint8_t", VoxelType::UInt8},
        {"short", VoxelType::Int16},
        {"short int", VoxelType::Int16},
        {"signed short", VoxelType::Int16},
        {"signed short int", VoxelType::Int16},
        {"int16", VoxelType::Int16},
        {"int16_t", VoxelType::Int16},
        {"ushort", VoxelType::UInt16},
        {"unsigned short", VoxelType::UInt16},
        {"unsigned short int", VoxelType::UInt16},
        {"uint16", VoxelType::UInt16},
        {"uint16_t", VoxelType::UInt16},
        {"int", VoxelType::Int32},
        {"signed int", VoxelType::Int32},
        {"int32", VoxelType::Int32},
        {"int32_t", VoxelType::Int32},
        {"uint", VoxelType::UInt32},
        {"unsigned int", VoxelType::UInt32},
        {"uint32", VoxelType::UInt32},
        {"uint32_t", VoxelType::UInt32},
        {"longlong", VoxelType::Int64},
        {"long long", VoxelType::Int64},
        {"int64", VoxelType::Int64},
        {"int64_t", VoxelType::Int64},
        {"ulonglong", VoxelType::UInt64},
        {"unsigned long long", VoxelType::UInt64},
        {"uint64", VoxelType::UInt64},
        {"uint64_t", VoxelType::UInt64},
        {"float", VoxelType::Float32},
        {"double", VoxelType::Float64}};
    const auto found = types.find(lower_case(text));
    if (found == types.end())
        bad_file(name, "its voxel type '" + text + "' is unknown", "export a scalar image");
    return found->second;
}

/// A vector "(x,y,z)", or nothing for "none".
using AxisVector = std::optional<Vec3>;

AxisVector parse_vector(std::string_view inside, const std::string& name) {
    Vec3 vector = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
        const auto comma = inside.find(',');
        const auto number = number_in(inside.substr(0, comma));
        if (!number || (i < 2) != (comma != std::string_view::npos))
            bad_file(name, "its header has a vector without three numbers",
                     "export the file again");
        vector[i] = *number;
        if (i < 2) inside.remove_prefix(comma + 1);
    }
    return vector;
}

std::vector<AxisVector> parse_vectors(std::string_view text, const std::string& name) {
    std::vector<AxisVector> vectors;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        if (text.front() == '(') {
            const auto close = text.find(')');
            if (close == std::string_view::npos)
                bad_file(name, "its header has an unfinished vector", "export the file again");
            vectors.push_back(parse_vector(text.substr(1, close - 1), name));
            text.remove_prefix(close + 1);
        } else {
            const auto end = std::min(text.find(' '), text.size());
            if (lower_case(text.substr(0, end)) != "none")
                bad_file(name, "its header has a direction that is not a vector",
                         "export the file again");
            vectors.emplace_back();
            text.remove_prefix(end);
        }
    }
    return vectors;
}

/// Signs that convert the file's space to LPS.
Vec3 signs_to_lps(const Fields& fields, const std::string& name, std::vector<std::string>& notes) {
    const std::string* space = find(fields, "space");
    const std::string text = space ? lower_case(*space) : "";
    if (text == "left-posterior-superior" || text == "lps") return {1.0, 1.0, 1.0};
    if (text == "right-anterior-superior" || text == "ras") return {-1.0, -1.0, 1.0};
    if (text == "left-anterior-superior" || text == "las") return {1.0, -1.0, 1.0};
    if (!text.empty() && text != "3d-right-handed" && text != "3d-left-handed" &&
        text != "scanner-xyz")
        bad_file(name, "its space '" + *space + "' is unknown",
                 "export it in left-posterior-superior");
    notes.emplace_back(
        "the file does not state the direction of its axes: left, posterior, superior is assumed");
    return {1.0, 1.0, 1.0};
}

/// Layers of a segmentation in which segments overlap: Slicer puts them into the first axis. 1: it
/// has none.
std::size_t layer_count(const Header& header, const std::vector<std::string>& sizes,
                        const std::vector<AxisVector>& directions) {
    constexpr double kMostLayers = 1000;
    const bool layered = sizes.size() == 4 && directions.size() == 4 && !directions[0] &&
                         header.pairs.contains("Segment0_Layer");
    const auto count = layered ? number_in(sizes[0]) : std::nullopt;
    const bool valid =
        count && *count >= 1.0 && *count <= kMostLayers && *count == std::floor(*count);
    return valid ? static_cast<std::size_t>(*count) : 1;
}

/// The file's spatial axes, and the others (of size 1, or that of the layers).
std::vector<std::size_t> spatial_axes(const std::vector<std::string>& sizes,
                                      const std::vector<AxisVector>& directions, bool layered,
                                      const std::string& name) {
    std::vector<std::size_t> axes;
    for (std::size_t a = layered ? 1 : 0; a < sizes.size(); ++a) {
        const bool spatial = directions.empty() || directions[a].has_value();
        const bool single = sizes[a] == "1";
        const bool surplus = directions.empty() && single && sizes.size() > 3;
        if (spatial && !surplus)
            axes.push_back(a);
        else if (!single)
            bad_file(name, "it holds " + sizes[a] + " values per voxel or volumes",
                     "export one scalar volume");
    }
    if (axes.size() != 3)
        bad_file(name, "it has " + std::to_string(axes.size()) + " axes in space, not 3",
                 "export one scalar volume");
    return axes;
}

double axis_spacing(const Fields& fields, std::size_t axis, std::vector<std::string>& notes) {
    if (const std::string* text = find(fields, "spacings")) {
        const auto words = words_of(*text);
        const auto value = axis < words.size() ? number_in(words[axis]) : std::nullopt;
        if (value && std::isfinite(*value) && *value != 0.0) return std::abs(*value);
    }
    const std::string note = "the file states no voxel size: 1 mm is assumed";
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    return 1.0;
}

std::optional<double> stated_unit(const Fields& fields, const std::string& name) {
    const std::string* text = find(fields, "spaceunits");
    if (!text) text = find(fields, "units");
    const auto words = words_of(text ? *text : "");
    std::string unit = words.empty() ? "" : lower_case(words.front());
    std::erase(unit, '"');
    if (unit == "mm" || unit == "millimeter" || unit == "millimetre") return 1.0;
    if (unit == "cm") return 10.0;
    if (unit == "m") return 1000.0;
    if (unit == "um" || unit == "micron" || unit == "\xc2\xb5m") return 1e-3;
    if (!unit.empty() && unit != "none" && unit != "???" && unit != "pixel")
        bad_file(name, "its unit of length '" + unit + "' is unknown", "export it in mm");
    return std::nullopt;
}

void place(const Fields& fields, const std::vector<AxisVector>& directions,
           const std::vector<std::size_t>& axes, const std::string& name, ImageFile& file,
           ImageHeader& header) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        if (directions.empty())
            matrix(column, column) = axis_spacing(fields, axes[i], file.notes);
        else
            matrix.block<3, 1>(0, column) = *directions[axes[i]];
    }
    if (const std::string* origin = find(fields, "spaceorigin")) {
        const auto vectors = parse_vectors(*origin, name);
        if (vectors.size() != 1 || !vectors[0])
            bad_file(name, "its space origin is not a vector", "export the file again");
        matrix.topRightCorner<3, 1>() = *vectors[0];
    }
    file.unit = stated_unit(fields, name);
    const Vec3 scale = file.unit.value_or(1.0) * signs_to_lps(fields, name, file.notes);
    matrix.topRows<3>() = (scale.asDiagonal() * matrix.topRows<3>()).eval();
    header.index_to_patient = matrix;
}

/// Bytes of the encoded voxels: after the header, or in the file it names.
std::string data_bytes(const std::string& path, const std::string& all, const Header& header,
                       const std::string& name) {
    const std::string* other = find(header.fields, "datafile");
    if (!other) return all.substr(header.data);
    return detached_bytes(path, *other, name);
}

std::size_t skipped(const Fields& fields, const std::string& key, const std::string& name) {
    const std::string* text = find(fields, key);
    const auto number = text ? number_in(*text) : 0.0;
    if (!number || *number < 0.0 || *number > 1e9)
        bad_file(name, "its field '" + key + "' is invalid", "save it as one file");
    return static_cast<std::size_t>(*number);
}

std::string_view skip(std::string_view data, const Fields& fields, std::size_t voxel_bytes,
                      const std::string& name) {
    for (std::size_t n = skipped(fields, "lineskip", name); n > 0; --n) {
        const auto end = data.find('\n');
        data.remove_prefix(end == std::string_view::npos ? data.size() : end + 1);
    }
    if (const std::string* text = find(fields, "byteskip"); text && *text == "-1")
        return data.substr(data.size() - std::min(data.size(), voxel_bytes));
    return data.substr(std::min(data.size(), skipped(fields, "byteskip", name)));
}

bool is_big_endian(const Fields& fields, VoxelType type, const std::string& name) {
    const std::string* endian = find(fields, "endian");
    if (!endian) {
        if (bytes_of(type) > 1 && needed(fields, "encoding", name) == "raw")
            bad_file(name, "its header does not state the byte order", "add 'endian: little'");
        return false;
    }
    return lower_case(*endian) == "big";
}

/// \param layers values for each voxel
Image decoded(ImageHeader header, std::size_t layers, std::string_view data, const Fields& fields,
              const std::string& name) {
    header.size[0] *= static_cast<int>(layers);
    const auto [i, j, k] = header.size;
    const std::size_t count = checked_voxel_count({i, j, k}, name);
    const std::size_t bytes = count * bytes_of(header.type);
    const std::string encoding = lower_case(needed(fields, "encoding", name));
    if (encoding == "raw") return image_from(header, skip(data, fields, bytes, name), name);
    if (encoding == "gzip" || encoding == "gz")
        return image_from(header, inflated(skip(data, fields, 0, name), bytes, name), name);
    if (encoding == "ascii" || encoding == "text" || encoding == "txt")
        return image_from(header, voxels_from_text(data, count, name), name);
    bad_file(name, "its encoding '" + encoding + "' is not supported",
             "save it with gzip encoding");
}

/// The layers of voxels that each hold the values of all of them.
std::vector<Image> layers_of(const Image& interleaved, std::size_t count) {
    Image layer = interleaved;
    layer.size[0] /= static_cast<int>(count);
    std::vector<Image> layers;
    for (std::size_t l = 0; l < count; ++l) {
        std::vector<float> voxels(layer.voxel_count());
        for (std::size_t v = 0; v < voxels.size(); ++v)
            voxels[v] = (*interleaved.voxels)[v * count + l];
        layer.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
        layers.push_back(layer);
    }
    return layers;
}

/// The image, or the layers of a segmentation, with the segments.
void take_voxels(const Image& all, std::size_t layers, const NrrdPairs& pairs, ImageFile& file) {
    file.image = all;
    if (layers > 1) {
        file.layers = layers_of(all, layers);
        file.image = file.layers.front();
        file.layers.erase(file.layers.begin());
    }
    read_slicer_segments(pairs, file);
}

}  // namespace

ImageFile read_nrrd(const std::string& path) {
    const std::string name = bare_name(path);
    const std::string content = file_content(path);
    const Header parsed = parse_header(content, name);
    const Fields& fields = parsed.fields;
    const auto sizes = words_of(needed(fields, "sizes", name));
    const auto dimension = number_in(needed(fields, "dimension", name));
    if (!dimension || *dimension != static_cast<double>(sizes.size()))
        bad_file(name, "its dimension and its sizes disagree", "export the file again");
    const std::string* stated = find(fields, "spacedirections");
    const auto directions = stated ? parse_vectors(*stated, name) : std::vector<AxisVector>();
    if (stated && directions.size() != sizes.size())
        bad_file(name, "its space directions and its sizes disagree", "export the file again");

    ImageFile file;
    ImageHeader header;
    const std::size_t layers = layer_count(parsed, sizes, directions);
    const auto axes = spatial_axes(sizes, directions, layers > 1, name);
    std::array<long long, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto n = number_in(sizes[axes[i]]);
        if (!n || !(std::abs(*n) < 1e9) || *n != std::floor(*n))
            bad_file(name, "its size '" + sizes[axes[i]] + "' is invalid", "the header is damaged");
        size[i] = static_cast<long long>(*n);
    }
    auto all = size;
    all[0] *= static_cast<long long>(layers);
    (void)checked_voxel_count(all, name);
    std::copy(size.begin(), size.end(), header.size.begin());
    header.type = voxel_type(needed(fields, "type", name), name);
    header.big_endian = is_big_endian(fields, header.type, name);
    place(fields, directions, axes, name, file, header);
    take_voxels(decoded(header, layers, data_bytes(path, content, parsed, name), fields, name),
                layers, parsed.pairs, file);
    return file;
}

void write_nrrd(const Image& image, const std::string& path, const Progress& progress) {
    const VoxelType type = smallest_type(image);
    const auto vector = [&](Eigen::Index column) {
        const Eigen::Vector3d v = image.index_to_patient.block<3, 1>(0, column);
        return "(" + number_text(v.x()) + "," + number_text(v.y()) + "," + number_text(v.z()) + ")";
    };
    std::string header = "NRRD0004\ntype: ";
    header += type == VoxelType::UInt8 ? "uchar" : (type == VoxelType::Int16 ? "short" : "float");
    header += "\ndimension: 3\nspace: left-posterior-superior\nsizes:";
    for (const int n : image.size) header += " " + std::to_string(n);
    header += "\nspace directions: " + vector(0) + " " + vector(1) + " " + vector(2);
    header += "\nkinds: domain domain domain\nspace units: \"mm\" \"mm\" \"mm\"";
    header += "\nendian: little\nencoding: gzip\nspace origin: " + vector(3) + "\n\n";
    write_file(path, header + deflated(stored_bytes(image, type), true, progress), progress);
}

}  // namespace vesselbench
