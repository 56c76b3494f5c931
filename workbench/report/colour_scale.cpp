#include "workbench/report/colour_scale.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/statistics.h"
#include "geometry/kernel/wording.h"
#include "workbench/report/label_text.h"

namespace vesselbench {

namespace {

constexpr double kLowest = 0.02, kHighest = 0.98;  ///< percentiles of an automatic range [-]
constexpr int kFoot = 76;                          ///< [pixels]
constexpr double kText = 13.0;                     ///< height of a digit [pixels]
constexpr double kBar = 14.0;                      ///< height of the colours [pixels]

void write_centred(Picture& picture, double x, double y, const std::string& text) {
    write_text(picture, x - 0.5 * text_width(text, kText), y, text, kText);
}

}  // namespace

ColourScale scale_for(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) return {};
    const auto [least, most] = std::ranges::minmax(values);
    if (least >= 0.0 && most <= 1.0) return {};
    const double low = percentile(values, kLowest), high = percentile(values, kHighest);
    if (low < 0.0 && high > 0.0) {
        const double full = std::max(-low, high);
        return {ColourMap::Diverging, -full, full};
    }
    if (high > low) return {ColourMap::Ordered, low, high};
    return {ColourMap::Ordered, least, most > least ? most : least + 1.0};
}

std::vector<Colour> colours_of(const std::vector<double>& values, const ColourScale& scale) {
    std::vector<Colour> colours;
    colours.reserve(values.size());
    for (const double value : values)
        colours.push_back(
            std::isfinite(value)
                ? colour_at(scale.map, (value - scale.least) / (scale.most - scale.least))
                : Colour::Constant(0.5F));
    return colours;
}

std::vector<PixelColour> legend_colours(const ColourScale& scale) {
    constexpr int kCount = 33;
    std::vector<PixelColour> colours;
    for (const Colour& colour : colour_steps(scale.map, kCount))
        colours.push_back(pixel_colour(colour));
    return colours;
}

Picture with_scale(const Picture& picture, const ColourScale& scale, const std::string& title) {
    Picture page = picture;
    page.height += kFoot;
    page.rgb.resize(
        3 * static_cast<std::size_t>(page.width) * static_cast<std::size_t>(page.height), 255);
    const double left = 0.15 * page.width, width = 0.7 * page.width, top = picture.height + 22.0;
    write_centred(page, 0.5 * page.width, top - 8.0, title);
    for (double x = 0.0; x < width; x += 1.0)
        draw_stroke(page, {left + x, top}, {left + x, top + kBar}, 1.2,
                    pixel_colour(colour_at(scale.map, x / width)));
    for (const double share : {0.0, 0.5, 1.0}) {
        const double x = left + share * width;
        draw_stroke(page, {x, top + kBar + 2.0}, {x, top + kBar + 7.0}, 1.2, {34, 34, 34});
        const double value = scale.least + share * (scale.most - scale.least);
        write_centred(page, x, top + kBar + 24.0, formatted(value, "%.3g"));
    }
    return page;
}

}  // namespace vesselbench
