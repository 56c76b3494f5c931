#include "geometry/formats/nifti.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/number_text.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

constexpr std::size_t kHeaderSize = 348;
constexpr std::size_t kDataOffset = 352;
/// A header extension is text; a larger offset is damaged.
constexpr double kLargestOffset = 1 << 24;

/// Reads header fields at their byte offsets (nifti1.h).
struct Fields {
    std::string_view bytes;
    bool swap = false;

    template <class T>
    [[nodiscard]] T at(std::size_t offset) const {
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), bytes.data() + offset, sizeof(T));
        if (swap) std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

    [[nodiscard]] int dim(int i) const { return at<std::int16_t>(40 + 2 * i); }

    [[nodiscard]] double pixdim(int i) const { return at<float>(76 + 4 * i); }
};

VoxelType voxel_type(int code, const std::string& name) {
    switch (code) {
        case 2:
            return VoxelType::UInt8;
        case 4:
            return VoxelType::Int16;
        case 8:
            return VoxelType::Int32;
        case 16:
            return VoxelType::Float32;
        case 64:
            return VoxelType::Float64;
        case 256:
            return VoxelType::Int8;
        case 512:
            return VoxelType::UInt16;
        case 768:
            return VoxelType::UInt32;
        case 1024:
            return VoxelType::Int64;
        case 1280:
            return VoxelType::UInt64;
        default:
            bad_file(name,
                     "its voxel type " + std::to_string(code) + " is not a single real number",
                     "export a scalar image");
    }
}

Eigen::Matrix4d sform_of(const Fields& fields) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
            matrix(r, c) = fields.at<float>(static_cast<std::size_t>(280 + 16 * r + 4 * c));
    return matrix;
}

Eigen::Matrix4d qform_of(const Fields& fields) {
    const double b = fields.at<float>(256), c = fields.at<float>(260), d = fields.at<float>(264);
    const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
    const double handedness = fields.pixdim(0) < 0.0 ? -1.0 : 1.0;  // qfac
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    const Vec3 scale(fields.pixdim(1), fields.pixdim(2), handedness * fields.pixdim(3));
    matrix.topLeftCorner<3, 3>() =
        Eigen::Quaterniond(a, b, c, d).normalized().toRotationMatrix() * scale.asDiagonal();
    for (int r = 0; r < 3; ++r)
        matrix(r, 3) = fields.at<float>(static_cast<std::size_t>(268 + 4 * r));
    return matrix;
}

/// Index to RAS in the header's unit.
Eigen::Matrix4d ras_matrix(const Fields& fields, std::vector<std::string>& notes) {
    if (fields.at<std::int16_t>(254) > 0) return sform_of(fields);
    if (fields.at<std::int16_t>(252) > 0) return qform_of(fields);
    notes.emplace_back(
        "the file states no orientation: axes right, anterior, superior and the first voxel as "
        "origin are assumed");
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 3; ++i) matrix(i, i) = fields.pixdim(i + 1);
    return matrix;
}

std::optional<double> stated_unit(const Fields& fields) {
    switch (fields.at<std::uint8_t>(123) & 7) {
        case 1:
            return 1000.0;
        case 2:
            return 1.0;
        case 3:
            return 1e-3;
        default:
            return std::nullopt;
    }
}

Fields checked_fields(std::string_view bytes, const std::string& name) {
    if (bytes.size() < kHeaderSize)
        bad_file(name, "it ends within the NIfTI header", "copy or download the file again");
    Fields fields{bytes, false};
    const auto is = [&](std::int32_t size) { return fields.at<std::int32_t>(0) == size; };
    constexpr std::int32_t kNifti2 = 540;
    fields.swap = !is(static_cast<std::int32_t>(kHeaderSize)) && !is(kNifti2);
    if (is(kNifti2)) bad_file(name, "it is a NIfTI-2 file", "convert it to NIfTI-1");
    if (!is(static_cast<std::int32_t>(kHeaderSize)) || bytes.substr(344, 3) != "n+1")
        bad_file(name, "it is not a NIfTI-1 file in one piece",
                 "convert it to a single NIfTI-1 file");
    return fields;
}

std::array<long long, 3> size_of(const Fields& fields, const std::string& name) {
    const int dimensions = fields.dim(0);
    if (dimensions < 1 || dimensions > 7)
        bad_file(name, "its header states " + std::to_string(dimensions) + " dimensions",
                 "the file is damaged");
    for (int i = 4; i <= dimensions; ++i)
        if (fields.dim(i) > 1)
            bad_file(
                name,
                "it holds " + std::to_string(fields.dim(i)) + " volumes (time steps or channels)",
                "export a single volume");
    std::array<long long, 3> size = {1, 1, 1};
    for (int i = 0; i < std::min(3, dimensions); ++i)
        size[static_cast<std::size_t>(i)] = fields.dim(i + 1);
    return size;
}

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

}  // namespace

ImageFile read_nifti(const std::string& path) {
    const std::string name = bare_name(path);
    const std::string stored = file_content(path);
    const bool packed = is_gzip(stored);
    const std::string head = packed ? inflated(stored, kHeaderSize, name, true) : std::string();
    const Fields fields = checked_fields(packed ? head : stored, name);

    ImageFile file;
    ImageHeader header;
    const auto size = size_of(fields, name);
    const std::size_t count = checked_voxel_count(size, name);
    std::copy(size.begin(), size.end(), header.size.begin());
    header.type = voxel_type(fields.at<std::int16_t>(70), name);
    header.big_endian = fields.swap;
    const double slope = fields.at<float>(112), intercept = fields.at<float>(116);
    if (std::isfinite(slope) && slope != 0.0 && std::isfinite(intercept)) {
        header.slope = slope;
        header.intercept = intercept;
    }
    file.unit = stated_unit(fields);
    const Eigen::Vector4d to_lps = file.unit.value_or(1.0) * Eigen::Vector4d(-1.0, -1.0, 1.0, 1.0);
    header.index_to_patient = to_lps.asDiagonal() * ras_matrix(fields, file.notes);
    header.index_to_patient.row(3) << 0.0, 0.0, 0.0, 1.0;

    const double offset = fields.at<float>(108);
    if (!(offset >= 0.0 && offset <= kLargestOffset))
        bad_file(name, "its header places the voxels at byte " + number_text(offset),
                 "the file is damaged");
    const std::size_t begin = std::max(kDataOffset, static_cast<std::size_t>(offset));
    const std::size_t end = begin + count * bytes_of(header.type);
    const std::string unpacked = packed ? inflated(stored, end, name) : std::string();
    const std::string_view all = packed ? unpacked : stored;
    file.image = image_from(header, all.substr(std::min(begin, all.size())), name);
    return file;
}

std::string nifti_bytes(const Image& image) {
    const VoxelType type = smallest_type(image);
    std::string bytes(kDataOffset, '\0');
    put(bytes, 0, static_cast<std::int32_t>(kHeaderSize));
    put<std::int16_t>(bytes, 40, 3);
    for (std::size_t i = 0; i < 7; ++i)
        put(bytes, 42 + 2 * i, static_cast<std::int16_t>(i < 3 ? image.size[i] : 1));
    put<std::int16_t>(bytes, 70,
                      type == VoxelType::UInt8 ? 2 : (type == VoxelType::Int16 ? 4 : 16));
    put(bytes, 72, static_cast<std::int16_t>(8 * bytes_of(type)));
    const Vec3 spacing = image.spacing();
    put(bytes, 76, 1.0f);
    for (std::size_t i = 0; i < 3; ++i)
        put(bytes, 80 + 4 * i, static_cast<float>(spacing[static_cast<Eigen::Index>(i)]));
    put(bytes, 108, static_cast<float>(kDataOffset));
    put(bytes, 112, 1.0f);
    put<std::uint8_t>(bytes, 123, 2);  // [mm]
    put<std::int16_t>(bytes, 254, 1);  // sform: scanner coordinates
    const Eigen::Matrix4d ras =
        Eigen::Vector4d(-1.0, -1.0, 1.0, 1.0).asDiagonal() * image.index_to_patient;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
            put(bytes, static_cast<std::size_t>(280 + 16 * r + 4 * c),
                static_cast<float>(ras(r, c)));
    std::memcpy(bytes.data() + 344, "n+1", 4);
    return bytes + stored_bytes(image, type);
}

void write_nifti(const Image& image, const std::string& path, const Progress& progress) {
    write_file(path, nifti_bytes(image), progress);
}

void write_compressed_nifti(const Image& image, const std::string& path, const Progress& progress) {
    write_file(path, deflated(nifti_bytes(image), true, progress), progress);
}

}  // namespace vesselbench
