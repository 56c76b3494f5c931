#include "gpu/transparency.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/errors.h"

namespace vesselbench {

ClearPicture without_background(const Picture& on_black, const Picture& on_white) {
    if (on_black.width != on_white.width || on_black.rgb.size() != on_white.rgb.size())
        throw InvalidInput("the pictures on black and on white have different sizes");
    ClearPicture clear{on_black.width, on_black.height, {}};
    clear.rgba.reserve(on_black.rgb.size() / 3 * 4);
    for (std::size_t at = 0; at + 2 < on_black.rgb.size(); at += 3) {
        // alpha c + (1 - alpha) b on the grounds b = 0 and b = 255: their difference is the same in
        // all three parts but for rounding.
        int through = 255;
        for (std::size_t part = at; part < at + 3; ++part)
            through = std::min(through, std::max(0, on_white.rgb[part] - on_black.rgb[part]));
        const int alpha = 255 - through;
        for (std::size_t part = at; part < at + 3; ++part) {
            const double colour = alpha == 0 ? 0.0 : std::round(255.0 * on_black.rgb[part] / alpha);
            clear.rgba.push_back(static_cast<std::uint8_t>(std::min(255.0, colour)));
        }
        clear.rgba.push_back(static_cast<std::uint8_t>(alpha));
    }
    return clear;
}

}  // namespace vesselbench
