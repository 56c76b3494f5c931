#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace vesselbench {

using Colour = Eigen::Vector3f;                   ///< linear RGB in [0, 1]
using PixelColour = std::array<std::uint8_t, 3>;  ///< as stored in pictures

/// Blue - white - red for -1...0...1, for signed deviations.
[[nodiscard]] Colour diverging_colour(double value);

/// The linearised heated-object scale (black - red - yellow - white) for 0...1: equal steps are
/// equal steps in lightness. Source: Levkowitz, Herman, "Color scales for image data", 1992.
[[nodiscard]] Colour heated_colour(double value);

/// Colours for numbers. Users of colour maps look values up as fractions of their range.
enum class ColourMap {
    Heated,      ///< heated_colour: small amounts of something, such as an error
    Diverging,   ///< diverging_colour, 0 in the middle of the range: signed deviations
    Ordered,     ///< dark violet - blue - green - yellow, equal steps in lightness, also legible to
                 ///< the colour-blind: any ordered number
    Categorical  ///< twelve distinct colours, one after the other: numbers that are names
};

/// The colour of a fraction in [0, 1] of a map's range, clamped.
[[nodiscard]] Colour colour_at(ColourMap map, double fraction);

/// A map in equal steps from 0 to 1, for shaders and legends.
[[nodiscard]] std::vector<Colour> colour_steps(ColourMap map, int count = 256);

/// One of twelve distinct colours, repeated.
[[nodiscard]] Colour category_colour(std::size_t number);

/// A vessel's wall.
inline const Colour kWallColour = {0.60F, 0.31F, 0.23F};

/// A colour as stored in pictures (gamma 2.2).
[[nodiscard]] PixelColour pixel_colour(const Colour& linear);

}  // namespace vesselbench
