#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How long and wide a connected piece of a surface is, as if it were a vessel.
struct PieceShape {
    std::size_t piece = 0;
    Vec3 centre = Vec3::Zero();  ///< of its area [mm]
    double length = 0.0;         ///< between its ends, straight [mm]
    double diameter = 0.0;       ///< of the tube of its length and area [mm]

    /// Longer than 3 diameters.
    [[nodiscard]] bool is_vessel() const { return length > 3.0 * diameter; }
};

/// \param piece_of_triangle #T, below `pieces`
/// \return by piece
[[nodiscard]] std::vector<PieceShape> piece_shapes(const Positions& points,
                                                   std::span<const Triangle> triangles,
                                                   std::span<const std::uint32_t> piece_of_triangle,
                                                   std::size_t pieces);

/// Of the pieces that are dropped, the longest vessel that is no crumb beside the longest piece
/// that is kept.
/// \param kept by piece
[[nodiscard]] std::optional<PieceShape> longest_dropped_vessel(
    const std::vector<PieceShape>& shapes, const std::vector<bool>& kept);

}  // namespace vesselbench
