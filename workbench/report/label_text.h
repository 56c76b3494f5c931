#pragma once

#include <string>

#include "gpu/picture.h"

namespace vesselbench {

/// Writes a text into a picture, in DejaVu Sans, anti-aliased.
/// \param x, y left end of the base line [pixels], y from the top
/// \param text UTF-8
/// \param size height of a digit [pixels]
void write_text(Picture& picture, double x, double y, const std::string& text, double size,
                const PixelColour& colour = {34, 34, 34});

/// Width of the text [pixels].
[[nodiscard]] double text_width(const std::string& text, double size);

/// A straight stroke with round ends.
void draw_stroke(Picture& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 double width, const PixelColour& colour);

}  // namespace vesselbench
