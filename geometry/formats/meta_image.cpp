#include "geometry/formats/meta_image.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/number_text.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

using Fields = std::map<std::string, std::string>;

struct Header {
    Fields fields;         ///< names in lower case
    std::size_t data = 0;  ///< offset of the first byte after the header
};

/// A MetaImage header is "Key = value" lines; ElementDataFile is its last.
Header parse_header(std::string_view bytes, const std::string& name) {
    Header header;
    std::size_t at = 0;
    while (at < bytes.size()) {
        const auto end = std::min(bytes.find('\n', at), bytes.size());
        const std::string_view line = trimmed(bytes.substr(at, end - at));
        at = std::min(end + 1, bytes.size());
        if (line.empty()) continue;
        const auto equals = line.find('=');
        if (equals == std::string_view::npos)
            bad_file(name, "its header has a line that is not 'key = value'",
                     "check that it is a MetaImage file");
        const std::string key = lower_case(trimmed(line.substr(0, equals)));
        header.fields[key] = trimmed(line.substr(equals + 1));
        if (key == "elementdatafile") {
            header.data = at;
            return header;
        }
    }
    bad_file(name, "it ends within its header", "copy or download the file again");
}

const std::string* find(const Fields& fields, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (const auto found = fields.find(key); found != fields.end()) return &found->second;
    return nullptr;
}

std::vector<double> numbers(const std::string& text, std::size_t count, const char* key,
                            const std::string& name) {
    std::vector<double> values;
    for (const auto& word : words_of(text))
        if (const auto number = number_in(word)) values.push_back(*number);
    if (values.size() != count || words_of(text).size() != count)
        bad_file(name,
                 std::string("its field ") + key + " does not have " + std::to_string(count) +
                     " numbers",
                 "export the file again");
    return values;
}

bool flag(const Fields& fields, std::initializer_list<const char*> keys, bool otherwise) {
    const std::string* text = find(fields, keys);
    return text ? lower_case(*text).starts_with('t') || *text == "1" : otherwise;
}

VoxelType voxel_type(const std::string& text, const std::string& name) {
    static const std::map<std::string, VoxelType> types = {
        {"MET_CHAR", VoxelType::Int8},       {"MET_UCHAR", VoxelType::UInt8},
        {"MET_SHORT", VoxelType::Int16},     {"MET_USHORT", VoxelType::UInt16},
        {"MET_INT", VoxelType::Int32},       {"MET_UINT", VoxelType::UInt32},
        {"MET_LONG", VoxelType::Int32},      {"MET_ULONG", VoxelType::UInt32},
        {"MET_LONG_LONG", VoxelType::Int64}, {"MET_ULONG_LONG", VoxelType::UInt64},
        {"MET_FLOAT", VoxelType::Float32},   {"MET_DOUBLE", VoxelType::Float64}};
    const auto found = types.find(text);
    if (found == types.end())
        bad_file(name, "its voxel type '" + text + "' is not a single real number",
                 "export a scalar image");
    return found->second;
}

std::optional<double> stated_unit(const Fields& fields, const std::string& name) {
    const std::string* text = find(fields, {"distanceunits"});
    if (!text || *text == "?") return std::nullopt;
    const std::string unit = lower_case(*text);
    if (unit == "mm") return 1.0;
    if (unit == "cm") return 10.0;
    if (unit == "m") return 1000.0;
    if (unit == "um") return 1e-3;
    bad_file(name, "its unit of length '" + *text + "' is unknown", "export it in mm");
}

void place(const Fields& fields, const std::string& name, ImageFile& file, ImageHeader& header) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    if (const auto* text = find(fields, {"transformmatrix", "rotation", "orientation"})) {
        const auto rows = numbers(*text, 9, "TransformMatrix", name);
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            for (Eigen::Index c = 0; c < 3; ++c)
                matrix(c, axis) = rows[static_cast<std::size_t>(3 * axis + c)];
    } else {
        file.notes.emplace_back(
            "the file states no orientation: left, posterior, superior is assumed");
    }
    std::vector<double> spacing(3, 1.0);
    if (const auto* text = find(fields, {"elementspacing", "elementsize"}))
        spacing = numbers(*text, 3, "ElementSpacing", name);
    else
        file.notes.emplace_back("the file states no voxel size: 1 mm is assumed");
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        matrix.col(axis) *= std::abs(spacing[static_cast<std::size_t>(axis)]);
    if (const auto* text = find(fields, {"offset", "origin", "position"})) {
        const auto offset = numbers(*text, 3, "Offset", name);
        matrix.topRightCorner<3, 1>() = Vec3(offset[0], offset[1], offset[2]);
    }
    file.unit = stated_unit(fields, name);
    matrix.topRows<3>() *= file.unit.value_or(1.0);
    header.index_to_patient = matrix;
}

void check_kind(const Fields& fields, const std::string& name) {
    const std::string* dimensions = find(fields, {"ndims"});
    if (!dimensions || *dimensions != "3")
        bad_file(name, "it is not an image of 3 dimensions", "export one scalar volume");
    const std::string* channels = find(fields, {"elementnumberofchannels"});
    if (channels && *channels != "1")
        bad_file(name, "it holds " + *channels + " values per voxel", "export one scalar volume");
    if (!find(fields, {"dimsize"}) || !find(fields, {"elementtype"}))
        bad_file(name, "its header has no DimSize or no ElementType", "export the file again");
}

std::string data_bytes(const std::string& path, const std::string& all, const Header& header,
                       const std::string& name) {
    const std::string& other = header.fields.at("elementdatafile");
    if (other == "LOCAL" || other == "Local" || other == "local") return all.substr(header.data);
    return detached_bytes(path, other, name);
}

Image decoded(const ImageHeader& header, std::string_view data, const Fields& fields,
              const std::string& name) {
    const auto [i, j, k] = header.size;
    const std::size_t count = checked_voxel_count({i, j, k}, name);
    const std::size_t bytes = count * bytes_of(header.type);
    if (!flag(fields, {"binarydata"}, true))
        return image_from(header, voxels_from_text(data, count, name), name);
    if (const auto* text = find(fields, {"headersize"})) {
        const double skip = numbers(*text, 1, "HeaderSize", name)[0];
        if (skip < 0.0)  // the voxels are at the file's end
            data = data.substr(data.size() - std::min(data.size(), bytes));
        else
            data = data.substr(
                static_cast<std::size_t>(std::min(skip, static_cast<double>(data.size()))));
    }
    if (flag(fields, {"compresseddata"}, false))
        return image_from(header, inflated(data, bytes, name), name);
    return image_from(header, data, name);
}

}  // namespace

ImageFile read_meta_image(const std::string& path) {
    const std::string name = bare_name(path);
    const std::string all = file_content(path);
    const Header parsed = parse_header(all, name);
    const Fields& fields = parsed.fields;
    check_kind(fields, name);

    ImageFile file;
    ImageHeader header;
    const auto stated = numbers(fields.at("dimsize"), 3, "DimSize", name);
    std::array<long long, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(std::abs(stated[i]) < 1e9) || stated[i] != std::floor(stated[i]))
            bad_file(name, "its DimSize is invalid", "the header is damaged");
        size[i] = static_cast<long long>(stated[i]);
    }
    (void)checked_voxel_count(size, name);
    std::copy(size.begin(), size.end(), header.size.begin());
    header.type = voxel_type(fields.at("elementtype"), name);
    header.big_endian = flag(fields, {"binarydatabyteordermsb", "elementbyteordermsb"}, false);
    place(fields, name, file, header);
    file.image = decoded(header, data_bytes(path, all, parsed, name), fields, name);
    return file;
}

void write_meta_image(const Image& image, const std::string& path, const Progress& progress) {
    const VoxelType type = smallest_type(image);
    const Vec3 spacing = image.spacing();
    const auto row = [](const Vec3& v) {
        return " " + number_text(v.x()) + " " + number_text(v.y()) + " " + number_text(v.z());
    };
    const std::string data = deflated(stored_bytes(image, type), false, progress);
    std::string header = "ObjectType = Image\nNDims = 3\nBinaryData = True\n";
    header += "BinaryDataByteOrderMSB = False\nCompressedData = True\n";
    header += "CompressedDataSize = " + std::to_string(data.size()) + "\nTransformMatrix =";
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        header += row(image.index_to_patient.block<3, 1>(0, axis) / spacing[axis]);
    header += "\nOffset =" + row(image.index_to_patient.topRightCorner<3, 1>());
    header += "\nCenterOfRotation = 0 0 0\nDistanceUnits = mm\nElementSpacing =" + row(spacing);
    header += "\nDimSize =";
    for (const int n : image.size) header += " " + std::to_string(n);
    header += "\nElementType = ";
    header += type == VoxelType::UInt8   ? "MET_UCHAR"
              : type == VoxelType::Int16 ? "MET_SHORT"
                                         : "MET_FLOAT";
    write_file(path, header + "\nElementDataFile = LOCAL\n" + data, progress);
}

}  // namespace vesselbench
