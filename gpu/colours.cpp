#include "gpu/colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

namespace {

/// CIE 1976 L*a*b* (D65) as linear RGB, clamped.
Colour from_lab(double lightness, double a, double b) {
    const auto cube = [](double t) {
        return t > 6.0 / 29.0 ? t * t * t : 3.0 * (36.0 / 841.0) * (t - 4.0 / 29.0);
    };
    const double middle = (lightness + 16.0) / 116.0;
    const Eigen::Vector3d xyz(0.9505 * cube(middle + a / 500.0), cube(middle),
                              1.0891 * cube(middle - b / 200.0));
    Eigen::Matrix3d to_rgb;  // sRGB's primaries, IEC 61966-2-1
    to_rgb << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
    return (to_rgb * xyz).cwiseMax(0.0).cwiseMin(1.0).cast<float>();
}

/// Lightness rises evenly; the hue runs through a few control colours (a*, b*).
Colour ordered_colour(double fraction) {
    constexpr std::array<std::array<double, 2>, 6> kHues = {
        {{28, -34}, {14, -42}, {-14, -24}, {-32, 6}, {-30, 44}, {2, 74}}};
    const double place = fraction * (kHues.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), kHues.size() - 2);
    const double share = place - static_cast<double>(i);
    return from_lab(16.0 + 74.0 * fraction, std::lerp(kHues[i][0], kHues[i + 1][0], share),
                    std::lerp(kHues[i][1], kHues[i + 1][1], share));
}

}  // namespace

Colour category_colour(std::size_t number) {
    constexpr double kGoldenAngle = 2.399963;  // [rad] neighbours in the list differ most
    const std::size_t i = number % 12;
    const double hue = 0.5 + kGoldenAngle * static_cast<double>(i);
    return from_lab(i % 3 == 0   ? 66.0
                    : i % 3 == 1 ? 52.0
                                 : 78.0,
                    46.0 * std::cos(hue), 46.0 * std::sin(hue));
}

Colour colour_at(ColourMap map, double fraction) {
    const double x = std::clamp(fraction, 0.0, 1.0);
    switch (map) {
        case ColourMap::Heated:
            return heated_colour(x);
        case ColourMap::Diverging:
            return diverging_colour(2.0 * x - 1.0);
        case ColourMap::Ordered:
            return ordered_colour(x);
        case ColourMap::Categorical:
            return category_colour(std::min<std::size_t>(static_cast<std::size_t>(12.0 * x), 11));
    }
    return Colour::Ones();
}

std::vector<Colour> colour_steps(ColourMap map, int count) {
    std::vector<Colour> steps;
    for (int i = 0; i < count; ++i)
        steps.push_back(colour_at(map, static_cast<double>(i) / std::max(count - 1, 1)));
    return steps;
}

PixelColour pixel_colour(const Colour& linear) {
    PixelColour pixel;
    for (int i = 0; i < 3; ++i)
        pixel[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
            std::lround(255.0 * std::pow(std::clamp(linear[i], 0.0F, 1.0F), 1.0F / 2.2F)));
    return pixel;
}

}  // namespace vesselbench
