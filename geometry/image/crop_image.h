#pragma once

#include "geometry/image/image.h"

namespace vesselbench {

/// The part of an image that contains an axis-parallel box in patient space, on the same grid:
/// whole voxels, at least two along each axis.
/// \param low,high corners of the box [mm], LPS, low < high
/// \throw InvalidInput if the box is empty or lies outside the image
[[nodiscard]] Image crop_to_box(const Image& image, const Vec3& low, const Vec3& high);

/// The part of an image that contains a ball.
/// \param centre [mm], LPS
/// \param radius [mm], > 0
/// \throw InvalidInput if the ball lies outside the image
[[nodiscard]] Image crop_to_sphere(const Image& image, const Vec3& centre, double radius);

}  // namespace vesselbench
