#include "workbench/review/page_thumbnail.h"

#include <cmath>

#include "geometry/kernel/errors.h"
#include "gpu/picture.h"
#include "gpu/png.h"

namespace vesselbench {

namespace {

constexpr int kPixels = 112;  ///< twice what the page's list shows

/// As the page draws them.
const Colour kWall(0.87F, 0.65F, 0.58F), kChanged(0.20F, 0.45F, 0.70F);
const Colour kBackground(0.93F, 0.94F, 0.95F);

/// A smaller distance is rounding [mm].
constexpr double kUnchanged = 1e-4;

}  // namespace

std::string thumbnail_png(const Surface& surface, std::span<const double> changed,
                          const Vec3& outward) {
    PictureOptions options{.width = kPixels, .height = kPixels};
    if (!outward.isZero()) {
        options.view = -outward;
        options.up = upward_for(options.view);
    }
    options.background = kBackground;
    options.vertex_colours.assign(surface.vertex_count(), kWall);
    for (std::size_t v = 0; v < changed.size(); ++v)
        if (std::abs(changed[v]) > kUnchanged) options.vertex_colours[v] = kChanged;
    try {
        return png(draw(surface, options));
    } catch (const GpuUnavailable&) {
        return {};
    }
}

}  // namespace vesselbench
