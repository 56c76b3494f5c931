#pragma once

#include <string>
#include <vector>

#include "gpu/colours.h"
#include "gpu/picture.h"

namespace vesselbench {

/// Values shown in colours: what the first and the last colour of a map mean.
struct ColourScale {
    ColourMap map = ColourMap::Ordered;
    double least = 0.0;
    double most = 1.0;
};

/// A scale for vertex values: 0 to 1 if all lie there, such as weights; diverging about 0 if they
/// have both signs; else their range. Of the latter two, 2 % at either end are cut off.
[[nodiscard]] ColourScale scale_for(std::vector<double> values);

/// One colour per value; grey where a value is not finite.
[[nodiscard]] std::vector<Colour> colours_of(const std::vector<double>& values,
                                             const ColourScale& scale);

/// The scale's colours in equal steps from `least` to `most`, for legends elsewhere: so many that
/// viewers may interpolate between them.
[[nodiscard]] std::vector<PixelColour> legend_colours(const ColourScale& scale);

/// The picture with the scale and a title below it.
[[nodiscard]] Picture with_scale(const Picture& picture, const ColourScale& scale,
                                 const std::string& title);

}  // namespace vesselbench
