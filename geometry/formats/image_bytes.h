#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

// Functions shared by the image readers and writers. `name` is always the file's name without its
// folder, for error texts.

/// How one voxel is stored.
enum class VoxelType { UInt8, Int8, UInt16, Int16, UInt32, Int32, UInt64, Int64, Float32, Float64 };

/// Bytes of one voxel.
[[nodiscard]] std::size_t bytes_of(VoxelType type);

/// Header values that describe an image beyond its voxel bytes.
struct ImageHeader {
    std::array<int, 3> size = {0, 0, 0};
    Eigen::Matrix4d index_to_patient = Eigen::Matrix4d::Identity();  ///< [mm], LPS
    VoxelType type = VoxelType::UInt8;
    bool big_endian = false;
    double slope = 1.0;      ///< voxel value = slope * stored + intercept
    double intercept = 0.0;  ///< see slope
};

/// \throw InvalidInput with the text "<name>: <cause>; <remedy>"
[[noreturn]] void bad_file(const std::string& name, const std::string& cause,
                           const std::string& remedy);

/// Voxels of a volume.
/// \throw InvalidInput if a size is below 1 or the volume has more than 2^30 voxels
[[nodiscard]] std::size_t checked_voxel_count(const std::array<long long, 3>& size,
                                              const std::string& name);

/// The content of the voxel file that a detached header names, relative to the header's folder.
/// \param header path \param other name of the voxel file, as in the header
/// \throw InvalidInput if these are several files, no file can have the name, or the file is not in
/// the header's folder; IoError
[[nodiscard]] std::string detached_bytes(const std::string& header, const std::string& other,
                                         const std::string& name);

/// True if the bytes start like a gzip stream.
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// The first `wanted` bytes of a gzip or zlib stream; unless `only_head` is set, the rest is
/// checked too, to detect a missing end or a wrong checksum.
/// \throw InvalidInput if it is damaged or truncated
[[nodiscard]] std::string inflated(std::string_view compressed, std::size_t wanted,
                                   const std::string& name, bool only_head = false);

/// A gzip (or else zlib) stream. \throw Cancelled
[[nodiscard]] std::string deflated(std::string_view bytes, bool gzip, const Progress& progress);

/// Turns stored bytes into an image. Bytes after the last voxel are ignored.
/// \throw InvalidInput if there are too few bytes, a voxel is not a finite number, or the matrix is
/// not finite or not invertible
[[nodiscard]] Image image_from(const ImageHeader& header, std::string_view bytes,
                               const std::string& name);

/// The same for voxels given as numbers; slope and intercept are applied.
[[nodiscard]] Image image_from(const ImageHeader& header, std::vector<float> voxels,
                               const std::string& name);

/// Numbers written as text, separated by white space, at most `count` of them.
/// \throw InvalidInput if one is not a number
[[nodiscard]] std::vector<float> voxels_from_text(std::string_view text, std::size_t count,
                                                  const std::string& name);

/// The smallest of uint8, int16 and float32 that holds every voxel exactly.
[[nodiscard]] VoxelType smallest_type(const Image& image);

/// Voxels stored little endian as uint8, int16 or float32.
[[nodiscard]] std::string stored_bytes(const Image& image, VoxelType type);

/// The number if the whole text is one (surrounding blanks allowed), else nothing.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

/// The text without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The text's words.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);

}  // namespace vesselbench
