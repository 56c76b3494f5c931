#include "gpu/colours.h"

#include <algorithm>
#include <cmath>

namespace vesselbench {

Colour diverging_colour(double value) {
    const auto v = static_cast<float>(std::clamp(value, -1.0, 1.0));
    const Colour neutral(0.80F, 0.80F, 0.78F), high(0.70F, 0.02F, 0.03F), low(0.03F, 0.10F, 0.55F);
    return v < 0.0F ? Colour(neutral + (low - neutral) * -v)
                    : Colour(neutral + (high - neutral) * v);
}

Colour heated_colour(double value) {
    // Luminances of full red, green and blue (sRGB); of a CIE 1976 lightness of 100 * value.
    constexpr double kRed = 0.2126, kGreen = 0.7152, kBlue = 0.0722;
    const double lightness = 100.0 * std::clamp(value, 0.0, 1.0);
    const double luminance =
        lightness > 8.0 ? std::pow((lightness + 16.0) / 116.0, 3.0) : lightness / 903.3;
    const auto part = [](double amount) {
        return static_cast<float>(std::clamp(amount, 0.0, 1.0));
    };
    return {part(luminance / kRed), part((luminance - kRed) / kGreen),
            part((luminance - kRed - kGreen) / kBlue)};
}

PixelColour pixel_colour(const Colour& linear) {
    PixelColour pixel;
    for (int i = 0; i < 3; ++i)
        pixel[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
            std::lround(255.0 * std::pow(std::clamp(linear[i], 0.0F, 1.0F), 1.0F / 2.2F)));
    return pixel;
}

}  // namespace vesselbench
