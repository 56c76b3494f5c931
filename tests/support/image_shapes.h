#pragma once

#include <functional>
#include <string>

#include "geometry/image/image.h"

namespace vesselbench::test {

/// Matrix with the given voxel edges [mm], turned by skew_rotation(), first voxel at `origin`.
/// \param mirrored flips the first axis: left-handed
[[nodiscard]] Eigen::Matrix4d oblique_matrix(const Vec3& spacing, const Vec3& origin,
                                             bool mirrored = false);

/// An image whose voxels are value(patient position).
[[nodiscard]] Image image_of(const std::array<int, 3>& size, const Eigen::Matrix4d& matrix,
                             const std::function<double(const Vec3&)>& value);

/// A ball of the given radius [mm] in the middle of a cubic grid: 100 inside, 0 outside, linear
/// over 2 mm about the radius (50 on it).
[[nodiscard]] Image ball_image(double radius, int size, const Vec3& spacing, bool mirrored = false);

/// Middle of an image [mm].
[[nodiscard]] Vec3 middle_of(const Image& image);

/// Why an image file is refused: the text of the InvalidInput, or "no error".
[[nodiscard]] std::string message_of(const std::string& path);

}  // namespace vesselbench::test
