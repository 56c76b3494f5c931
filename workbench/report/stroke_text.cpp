#include "workbench/report/stroke_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace vesselbench {

namespace {

/// Strokes of each letter through points "xy" of a grid: x 0 to 4, base line at y 2, digits up to
/// 8, small letters up to 6; a bar begins a new stroke.
const std::map<char, const char*>& glyphs() {
    static const std::map<char, const char*> all = {
        {'0', "12 03 07 18 38 47 43 32 12"},
        {'1', "06 28 22|12 32"},
        {'2', "07 18 38 47 46 02 42"},
        {'3', "07 18 38 47 46 35 25|35 44 43 32 12 03"},
        {'4', "32 38 04 44"},
        {'5', "48 08 05 35 44 43 32 12 03"},
        {'6', "47 38 18 07 03 12 32 43 44 35 15 04"},
        {'7', "08 48 12"},
        {'8', "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"},
        {'9', "03 12 32 43 47 38 18 07 06 15 35 46"},
        {'a', "45 36 16 05 03 12 32 43|46 42"},
        {'b', "08 02|05 16 36 45 43 32 12 03"},
        {'c', "45 36 16 05 03 12 32 43"},
        {'d', "48 42|45 36 16 05 03 12 32 43"},
        {'e', "04 44 45 36 16 05 03 12 32 43"},
        {'f', "38 28 17 12|06 36"},
        {'g', "46 41 30 10|45 36 16 05 03 12 32 43"},
        {'h', "08 02|05 16 36 45 42"},
        {'i', "26 22|28 28"},
        {'j', "26 21 10|28 28"},
        {'k', "08 02|46 04|15 42"},
        {'l', "28 22"},
        {'m', "02 06|05 16 25 22|25 36 45 42"},
        {'n', "02 06|05 16 36 45 42"},
        {'o', "16 05 03 12 32 43 45 36 16"},
        {'p', "06 00|05 16 36 45 43 32 12 03"},
        {'q', "46 40|45 36 16 05 03 12 32 43"},
        {'r', "02 06|05 16 36"},
        {'s', "45 36 16 05 14 34 43 32 12 03"},
        {'t', "18 13 22 32|06 36"},
        {'u', "06 03 12 32 43|46 42"},
        {'v', "06 22 46"},
        {'w', "06 12 25 32 46"},
        {'x', "06 42|02 46"},
        {'y', "06 23|46 10"},
        {'z', "06 46 02 42"},
        {'.', "22 22"},
        {',', "22 11"},
        {':', "25 25|22 22"},
        {';', "25 25|22 11"},
        {'-', "14 34"},
        {'+', "04 44|26 22"},
        {'=', "05 45|03 43"},
        {'/', "02 48"},
        {'_', "02 42"},
        {'|', "28 20"},
        {'(', "38 26 24 32"},
        {')', "18 26 24 12"},
        {'[', "38 18 12 32"},
        {']', "18 38 32 12"},
        {'%', "02 48|07 17 18 08 07|32 42 43 33 32"}};
    return all;
}

constexpr double kAdvance = 5.6, kDigit = 6.0;  // grid units

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
    const double unit = size / kDigit;
    const double width = std::max(1.1, 0.11 * size);
    for (const char letter : text) {
        const auto glyph =
            glyphs().find(static_cast<char>(std::tolower(static_cast<unsigned char>(letter))));
        const std::string strokes = glyph == glyphs().end() ? "" : glyph->second;
        Eigen::Vector2d last(0, 0);
        bool drawing = false;
        for (std::size_t i = 0; i + 1 < strokes.size(); i += 3) {
            const Eigen::Vector2d at(x + unit * (strokes[i] - '0'),
                                     y - unit * (strokes[i + 1] - '2'));
            if (drawing) draw_stroke(picture, last, at, width, colour);
            last = at;
            drawing = i + 2 < strokes.size() && strokes[i + 2] == ' ';
        }
        x += kAdvance * unit;
    }
}

double text_width(const std::string& text, double size) {
    return static_cast<double>(text.size()) * kAdvance * size / kDigit;
}

}  // namespace vesselbench
