#include "workbench/report/report_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "geometry/errors.h"
#include "geometry/measure.h"
#include "geometry/surface_distance.h"
#include "gpu/picture.h"

namespace vesselbench {

namespace {

struct View {
    const char* name;
    Vec3 direction;
    Vec3 up;
};

/// Patient coordinates are LPS: +y is posterior, +z is superior.
const std::array<View, 3> kViews = {{{"from the front", Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                     {"from the left", Vec3(-1, 0, 0), Vec3(0, 0, 1)},
                                     {"from above", Vec3(0, 0, -1), Vec3(0, -1, 0)}}};

constexpr int kPixels = 700;

std::string drawn(const Surface& surface, const View& view, std::vector<Colour> colours) {
    return png(draw(surface, {.width = kPixels,
                              .height = kPixels,
                              .view = view.direction,
                              .up = view.up,
                              .vertex_colours = std::move(colours)}));
}

/// The deviation that the full colour stands for [mm]: 1.5 times what 85 of 100 vertices stay
/// below, so that extruded ends do not wash out the rest.
double colour_scale(std::vector<double> deviations) {
    for (double& deviation : deviations) deviation = std::abs(deviation);
    const auto place = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() * 0.85);
    std::ranges::nth_element(deviations, place);
    return std::max(1.5 * *place, 1e-6);
}

}  // namespace

std::vector<ReportPicture> report_pictures(const Surface& surface, const Surface* source) {
    std::vector<ReportPicture> pictures;
    try {
        for (const View& view : kViews)
            pictures.push_back({std::string("Patches, ") + view.name, drawn(surface, view, {})});
        if (source == nullptr) return pictures;
        const std::vector<double> deviations =
            SurfaceDistance(*source).signed_distances(surface.points());
        const double scale = colour_scale(deviations);
        std::vector<Colour> colours;
        for (const double deviation : deviations)
            colours.push_back(diverging_colour(std::clamp(deviation / scale, -1.0, 1.0)));
        char title[128];
        for (const View& view : kViews) {
            std::snprintf(title, sizeof title,
                          "Deviation from the source, %s: blue -%.2g mm, red +%.2g mm", view.name,
                          scale, scale);
            pictures.push_back({title, drawn(surface, view, colours)});
        }
    } catch (const GpuUnavailable&) {
        return {};
    }
    return pictures;
}

}  // namespace vesselbench
