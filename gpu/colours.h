#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace vesselbench {

using Colour = Eigen::Vector3f;                   ///< linear RGB in [0, 1]
using PixelColour = std::array<std::uint8_t, 3>;  ///< as stored in pictures

/// Blue - white - red for -1...0...1, for signed deviations.
[[nodiscard]] Colour diverging_colour(double value);

/// The linearised heated-object scale (black - red - yellow - white) for 0...1: equal steps are
/// equal steps in lightness. Source: Levkowitz, Herman, "Color scales for image data", 1992.
[[nodiscard]] Colour heated_colour(double value);

/// A colour as stored in pictures (gamma 2.2).
[[nodiscard]] PixelColour pixel_colour(const Colour& linear);

}  // namespace vesselbench
