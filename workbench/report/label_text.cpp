#include "workbench/report/label_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

#include "geometry/kernel/errors.h"
#include "workbench/report/label_font.h"

namespace vesselbench {

namespace {

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo info = [] {
        stbtt_fontinfo made = {};
        if (stbtt_InitFont(&made, label_font().data(), 0) == 0)
            throw AlgorithmFailure("the embedded font cannot be used");
        return made;
    }();
    return info;
}

/// Pixels per font unit, for digits of this height.
double scale_of(double size) {
    int left = 0, bottom = 0, right = 0, top = 0;
    stbtt_GetCodepointBox(&font(), '1', &left, &bottom, &right, &top);
    return size / (top - bottom);
}

/// The code points of a UTF-8 text; a byte out of place stands for itself.
std::vector<int> code_points(const std::string& text) {
    std::vector<int> points;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0) == 0x80 && !points.empty())
            points.back() = points.back() << 6 | (byte & 0x3F);
        else
            points.push_back(byte < 0xC0   ? byte
                             : byte < 0xE0 ? byte & 0x1F
                             : byte < 0xF0 ? byte & 0x0F
                                           : byte & 0x07);
    }
    return points;
}

/// Calls `visit(glyph, x)` for every glyph, x from the start of the text [pixels].
/// \return the width of the text [pixels]
template <class Visit>
double lay_out(const std::string& text, double scale, Visit visit) {
    double x = 0.0;
    int last = 0;
    for (const int point : code_points(text)) {
        const int glyph = stbtt_FindGlyphIndex(&font(), point);
        if (last != 0) x += scale * stbtt_GetGlyphKernAdvance(&font(), last, glyph);
        visit(glyph, x);
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
        x += scale * advance;
        last = glyph;
    }
    return x;
}

/// Mixes a colour over a pixel.
void blend(Picture& picture, int x, int y, const PixelColour& colour, double share) {
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
    auto* pixel = picture.rgb.data() +
                  3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(x));
    for (std::size_t i = 0; i < 3; ++i)
        pixel[i] = static_cast<std::uint8_t>(
            std::lround(pixel[i] + share * (static_cast<double>(colour[i]) - pixel[i])));
}

}  // namespace

void draw_stroke(Picture& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 double width, const PixelColour& colour) {
    const double radius = 0.5 * width;
    const Eigen::Vector2d low = from.cwiseMin(to), high = from.cwiseMax(to);
    const Eigen::Vector2d way = to - from;
    const double squared = way.squaredNorm();
    for (int y = static_cast<int>(low.y() - radius - 1); y <= high.y() + radius + 1; ++y)
        for (int x = static_cast<int>(low.x() - radius - 1); x <= high.x() + radius + 1; ++x) {
            const Eigen::Vector2d at(x + 0.5, y + 0.5);
            const double t =
                squared > 0.0 ? std::clamp((at - from).dot(way) / squared, 0.0, 1.0) : 0.0;
            const double distance = (at - from - t * way).norm();
            const double share = std::clamp(radius + 0.5 - distance, 0.0, 1.0);
            if (share > 0.0) blend(picture, x, y, colour, share);
        }
}

void write_text(Picture& picture, double x, double y, const std::string& text, double size,
                const PixelColour& colour) {
    const auto scale = static_cast<float>(scale_of(size));
    const double line = std::round(y);
    lay_out(text, scale, [&](int glyph, double along) {
        const double at = std::floor(x + along);
        const auto shift = static_cast<float>(x + along - at);
        int left = 0, top = 0, right = 0, bottom = 0;
        stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, shift, 0.0f, &left, &top,
                                        &right, &bottom);
        const int width = right - left, height = bottom - top;
        std::vector<unsigned char> cover(static_cast<std::size_t>(width * height));
        stbtt_MakeGlyphBitmapSubpixel(&font(), cover.data(), width, height, width, scale, scale,
                                      shift, 0.0f, glyph);
        for (int i = 0; i < width * height; ++i)
            blend(picture, static_cast<int>(at) + left + i % width,
                  static_cast<int>(line) + top + i / width, colour,
                  cover[static_cast<std::size_t>(i)] / 255.0);
    });
}

double text_width(const std::string& text, double size) {
    return lay_out(text, scale_of(size), [](int, double) {});
}

}  // namespace vesselbench
