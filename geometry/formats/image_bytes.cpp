#include "geometry/formats/image_bytes.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/LU>
#include <zlib.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

static_assert(std::endian::native == std::endian::little, "stored_bytes writes native floats");

/// More than a whole-body CT; beyond it the header is damaged or the machine too small.
constexpr std::size_t kMostVoxels = std::size_t{1} << 30;
/// Data is inflated piecewise: a damaged header never causes a large allocation.
constexpr std::size_t kPiece = std::size_t{1} << 22;

constexpr std::size_t kLargestRatio = 1032;  ///< of zlib

template <class T>
T stored_value(const char* at, bool swap) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), at, sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
}

template <class T>
void convert(std::string_view bytes, bool swap, std::vector<float>& voxels) {
    for (std::size_t i = 0; i < voxels.size(); ++i)
        voxels[i] = static_cast<float>(stored_value<T>(bytes.data() + i * sizeof(T), swap));
}

std::vector<float> converted(const ImageHeader& header, std::string_view bytes, std::size_t count) {
    std::vector<float> voxels(count);
    const bool swap = header.big_endian;
    switch (header.type) {
        case VoxelType::UInt8:
            convert<std::uint8_t>(bytes, swap, voxels);
            break;
        case VoxelType::Int8:
            convert<std::int8_t>(bytes, swap, voxels);
            break;
        case VoxelType::UInt16:
            convert<std::uint16_t>(bytes, swap, voxels);
            break;
        case VoxelType::Int16:
            convert<std::int16_t>(bytes, swap, voxels);
            break;
        case VoxelType::UInt32:
            convert<std::uint32_t>(bytes, swap, voxels);
            break;
        case VoxelType::Int32:
            convert<std::int32_t>(bytes, swap, voxels);
            break;
        case VoxelType::UInt64:
            convert<std::uint64_t>(bytes, swap, voxels);
            break;
        case VoxelType::Int64:
            convert<std::int64_t>(bytes, swap, voxels);
            break;
        case VoxelType::Float32:
            convert<float>(bytes, swap, voxels);
            break;
        case VoxelType::Float64:
            convert<double>(bytes, swap, voxels);
            break;
    }
    return voxels;
}

void check_matrix(const Eigen::Matrix4d& matrix, const std::string& name) {
    const Eigen::Matrix3d axes = matrix.topLeftCorner<3, 3>();
    const double product = axes.colwise().norm().prod();
    // Sine of the angles between the axes below which they span no volume.
    constexpr double kFlat = 1e-3;
    if (!matrix.allFinite())
        bad_file(name, "its orientation or spacing contains a value that is not a number",
                 "export the file again with valid geometry");
    if (!(product > 0.0) || std::abs(axes.determinant()) < kFlat * product)
        bad_file(name, "its spacing or orientation is degenerate (an axis of length 0)",
                 "export the file again with valid geometry");
}

void check_finite(const std::vector<float>& voxels, const std::string& name) {
    const auto bad =
        std::count_if(voxels.begin(), voxels.end(), [](float v) { return !std::isfinite(v); });
    if (bad > 0)
        bad_file(name,
                 std::to_string(bad) + " of its " + std::to_string(voxels.size()) +
                     " voxels are not finite numbers",
                 "replace them with the background value");
}

template <class T>
void append(std::string& bytes, float value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(static_cast<T>(value));
    bytes.append(raw.data(), raw.size());
}

}  // namespace

std::size_t bytes_of(VoxelType type) {
    switch (type) {
        case VoxelType::UInt8:
        case VoxelType::Int8:
            return 1;
        case VoxelType::UInt16:
        case VoxelType::Int16:
            return 2;
        case VoxelType::UInt32:
        case VoxelType::Int32:
        case VoxelType::Float32:
            return 4;
        default:
            return 8;
    }
}

void bad_file(const std::string& name, const std::string& cause, const std::string& remedy) {
    throw InvalidInput(name + ": " + cause + "; " + remedy);
}

std::size_t checked_voxel_count(const std::array<long long, 3>& size, const std::string& name) {
    const auto text =
        std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
    std::size_t count = 1;
    for (const long long n : size) {
        if (n < 1)
            bad_file(name, "its size is " + text + " voxels", "the file is empty or damaged");
        if (static_cast<std::size_t>(n) > kMostVoxels / count)
            bad_file(name, "its size is " + text + " voxels, more than 2^30",
                     "the header is damaged, or the image must be cropped first");
        count *= static_cast<std::size_t>(n);
    }
    return count;
}

std::string detached_bytes(const std::string& header, const std::string& other,
                           const std::string& name) {
    if (other.starts_with("LIST") || other.find('%') != std::string::npos)
        bad_file(name, "its voxels are in several files", "save it as one file");
    if (other.empty() || printable(other) != other)
        bad_file(name, "the name of its voxel file is '" + shortened(printable(other)) + "'",
                 "export the file again");
    return file_content(
        inner_file(std::filesystem::path(header).parent_path(), other, name + ": its voxel file"));
}

bool is_gzip(std::string_view bytes) {
    return bytes.size() > 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

namespace {

/// A zlib decompressor fed from memory.
class Inflater {
public:
    Inflater(std::string_view compressed, const std::string& name)
        : compressed_(compressed), name_(name) {
        constexpr int kGzipOrZlib = 15 + 32;
        if (inflateInit2(&stream_, kGzipOrZlib) != Z_OK)
            throw IoError(name + ": cannot start zlib");
    }

    ~Inflater() { inflateEnd(&stream_); }

    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /// Fills the span or less; returns 0 at the stream's regular end. \throw InvalidInput if
    /// damaged
    std::size_t read(char* out, std::size_t size) {
        stream_.next_out = reinterpret_cast<Bytef*>(out);
        stream_.avail_out = static_cast<uInt>(size);
        while (!ended_ && stream_.avail_out == size) {
            const auto feed = std::min<std::size_t>(compressed_.size() - fed_, 1u << 30);
            stream_.next_in =
                reinterpret_cast<Bytef*>(const_cast<char*>(compressed_.data() + fed_));
            stream_.avail_in = static_cast<uInt>(feed);
            const int state = inflate(&stream_, Z_NO_FLUSH);
            fed_ += feed - stream_.avail_in;
            if (state == Z_STREAM_END)
                next_member();
            else if (state == Z_BUF_ERROR ||
                     (state == Z_OK && fed_ == compressed_.size() && stream_.avail_out == size))
                bad_file(name_, "its compressed data is truncated",
                         "the file is truncated: copy or download it again");
            else if (state != Z_OK)
                bad_file(name_, "its compressed data is damaged",
                         "copy or download the file again");
        }
        return size - stream_.avail_out;
    }

private:
    /// gzip allows several members in a row; any other data behind them is ignored.
    void next_member() {
        ended_ = !is_gzip(compressed_.substr(fed_));
        if (!ended_) inflateReset(&stream_);
    }

    std::string_view compressed_;
    const std::string& name_;
    z_stream stream_{};
    std::size_t fed_ = 0;
    bool ended_ = false;
};

}  // namespace

std::string inflated(std::string_view compressed, std::size_t wanted, const std::string& name,
                     bool only_head) {
    if (wanted / kLargestRatio > compressed.size())
        bad_file(name,
                 "it announces " + std::to_string(wanted) + " bytes, which cannot be in " +
                     std::to_string(compressed.size()) + " compressed ones",
                 "the file is damaged: copy or download it again");
    Inflater inflater(compressed, name);
    std::string out;
    while (out.size() < wanted) {
        const std::size_t before = out.size();
        out.resize(std::min(wanted, before + kPiece));
        const std::size_t got = inflater.read(out.data() + before, out.size() - before);
        out.resize(before + got);
        if (got == 0)
            bad_file(name,
                     "its data ends after " + std::to_string(out.size()) + " of " +
                         std::to_string(wanted) + " bytes",
                     "the file is truncated: copy or download it again");
    }
    std::string rest(only_head ? 0 : 4096, '\0');
    while (!rest.empty() && inflater.read(rest.data(), rest.size()) > 0) continue;
    return out;
}

std::string deflated(std::string_view bytes, bool gzip, const Progress& progress) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, gzip ? 15 + 16 : 15, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw IoError("cannot start zlib");
    const std::unique_ptr<z_stream, int (*)(z_stream*)> ended(&stream, deflateEnd);
    std::string out;
    std::string piece(kPiece, '\0');
    std::size_t fed = 0;
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        progress.check_cancelled();
        const std::size_t feed = std::min(bytes.size() - fed, kPiece);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + fed));
        stream.avail_in = static_cast<uInt>(feed);
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        state = deflate(&stream, fed + feed == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        fed += feed - stream.avail_in;
        out.append(piece, 0, piece.size() - stream.avail_out);
    }
    return out;
}

Image image_from(const ImageHeader& header, std::string_view bytes, const std::string& name) {
    const std::size_t count =
        checked_voxel_count({header.size[0], header.size[1], header.size[2]}, name);
    const std::size_t needed = count * bytes_of(header.type);
    if (bytes.size() < needed)
        bad_file(name,
                 "its voxels need " + std::to_string(needed) + " bytes, but only " +
                     std::to_string(bytes.size()) + " are present",
                 "the file is truncated: copy or download it again");
    return image_from(header, converted(header, bytes, count), name);
}

Image image_from(const ImageHeader& header, std::vector<float> voxels, const std::string& name) {
    check_matrix(header.index_to_patient, name);
    if (header.slope != 1.0 || header.intercept != 0.0)
        for (float& v : voxels)
            v = static_cast<float>(header.slope * static_cast<double>(v) + header.intercept);
    check_finite(voxels, name);
    Image image;
    image.size = header.size;
    image.index_to_patient = header.index_to_patient;
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return image;
}

std::vector<float> voxels_from_text(std::string_view text, std::size_t count,
                                    const std::string& name) {
    std::vector<float> voxels;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (voxels.size() < count) {
        while (at != end && (std::isspace(static_cast<unsigned char>(*at)) || *at == ',')) ++at;
        if (at == end)
            bad_file(name,
                     "its text ends after " + std::to_string(voxels.size()) + " of " +
                         std::to_string(count) + " voxels",
                     "the file is truncated: copy or download it again");
        double value = 0.0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc())
            bad_file(name, "voxel " + std::to_string(voxels.size()) + " is not a number",
                     "export the file again");
        voxels.push_back(static_cast<float>(value));
        at = next;
    }
    return voxels;
}

VoxelType smallest_type(const Image& image) {
    bool whole = true;
    float least = 0.0f, most = 0.0f;
    for (const float v : *image.voxels) {
        whole = whole && v == std::floor(v);
        least = std::min(least, v);
        most = std::max(most, v);
    }
    if (whole && least >= 0.0f && most <= 255.0f) return VoxelType::UInt8;
    if (whole && least >= -32768.0f && most <= 32767.0f) return VoxelType::Int16;
    return VoxelType::Float32;
}

std::string stored_bytes(const Image& image, VoxelType type) {
    std::string bytes;
    bytes.reserve(image.voxel_count() * bytes_of(type));
    for (const float v : *image.voxels) switch (type) {
            case VoxelType::UInt8:
                append<std::uint8_t>(bytes, v);
                break;
            case VoxelType::Int16:
                append<std::int16_t>(bytes, v);
                break;
            default:
                append<float>(bytes, v);
                break;
        }
    return bytes;
}

std::optional<double> number_in(std::string_view text) {
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    const auto first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        const auto end = text.find_first_of(" \t\r\n\v\f");
        words.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) break;
        text.remove_prefix(end);
    }
    return words;
}

}  // namespace vesselbench
