#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The part of a surface inside an axis-parallel box: triangles are cut at the box and left open
/// there; patches and attributes are carried over, vertices of the cut lie on the box.
/// \param low,high corners of the box [mm], LPS, low < high
/// \throw InvalidInput if the box is empty
/// \throw AlgorithmFailure if nothing of the surface lies inside
[[nodiscard]] Surface crop_to_box(const Surface& surface, const Vec3& low, const Vec3& high);

/// The same for a ball. A triangle with all corners outside is dropped, even if its interior
/// touches the ball.
/// \param centre [mm], LPS
/// \param radius [mm], > 0
[[nodiscard]] Surface crop_to_sphere(const Surface& surface, const Vec3& centre, double radius);

/// A surface's connected piece (over shared vertices) of largest area, and the number of all
/// pieces.
struct LargestPiece {
    Surface surface;
    std::size_t pieces = 0;
};

[[nodiscard]] LargestPiece largest_piece(const Surface& surface);

}  // namespace vesselbench
