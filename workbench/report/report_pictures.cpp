#include "workbench/report/report_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/wording.h"
#include "gpu/png.h"
#include "workbench/report/label_text.h"

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

/// Height of the ends' numbers: they are read in pictures shown at half their size, too [pixels].
constexpr double kDigit = 26.0;

/// Half the height of a view that shows a surface and the numbers beside its ends [mm].
double marked_half_height(const Surface& surface, const View& view) {
    constexpr double kMargin = 1.12;
    const Vec3 centre = bounds(surface).centre();
    const Vec3 right = view.direction.cross(view.up);
    double most = 0.0;
    for (const Vec3& p : surface.points())
        most = std::max(
            {most, std::abs((p - centre).dot(right)), std::abs((p - centre).dot(view.up))});
    return kMargin * most;
}

PictureOptions options_for(const View& view, std::vector<Colour> colours) {
    return {.width = kPixels,
            .height = kPixels,
            .view = view.direction,
            .up = view.up,
            .vertex_colours = std::move(colours)};
}

/// Pictures of one surface and their titles.
struct Series {
    std::vector<std::string> titles;
    std::vector<PictureOptions> views;

    void add(const std::string& what, const std::vector<Colour>& colours,
             const std::string& legend = "") {
        for (const View& view : kViews) {
            titles.push_back(what + ", " + view.name + legend);
            views.push_back(options_for(view, colours));
        }
    }

    void draw_into(std::vector<ReportPicture>& pictures, const Surface& surface,
                   std::span<const EndMark> ends = {}) const {
        if (views.empty()) return;
        std::vector<Picture> drawn = draw_views(surface, views);
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            draw_marks(drawn[i], ends, views[i], bounds(surface).centre(), kDigit);
            pictures.push_back({titles[i], png(drawn[i])});
        }
    }
};

/// Each view just holds the surface and its marks.
Series series_of_patches(const Surface& surface) {
    Series series;
    series.add("Patches", {});
    for (std::size_t i = 0; i < kViews.size(); ++i)
        series.views[i].half_height = marked_half_height(surface, kViews[i]);
    return series;
}

Series series_of_deviation(const Surface& surface, const PictureSource& source) {
    Series series;
    const auto [colours, full] = deviation_colours(surface, source.surface, source.comparable);
    series.add("Deviation from the source", colours, ": " + deviation_legend(full));
    return series;
}

/// Empty if nothing of the source was lost or left closed.
Series series_of_source(const PictureSource& source, const Surface& model) {
    const auto fates = source_fates(source.surface, model, source.closed);
    const bool lost = std::ranges::count(fates, SourceFate::Lost) > 0;
    const bool closed = std::ranges::count(fates, SourceFate::Closed) > 0;
    Series series;
    if (!lost && !closed) return series;
    std::vector<Colour> colours;
    for (const SourceFate fate : fates) colours.push_back(fate_colour(fate));
    series.add("The source", colours,
               std::string(": ") + (lost ? "blue is not in the model" : "") +
                   (lost && closed ? ", " : "") + (closed ? "violet ends are closed" : ""));
    return series;
}

}  // namespace

void draw_marks(Picture& picture, std::span<const EndMark> ends, const PictureOptions& options,
                const Vec3& centre, double digit) {
    // Of numbers: roles' colours are too light for thin strokes on white.
    constexpr PixelColour kInk = {25, 30, 35};
    const Vec3 right = options.view.cross(options.up).normalized();
    const Vec3 up = right.cross(options.view).normalized();
    const double scale = 0.5 * picture.height / options.half_height;
    for (const EndMark& end : ends) {
        const Vec3 p = end.place - centre;
        const Eigen::Vector2d at(0.5 * picture.width + scale * p.dot(right),
                                 0.5 * picture.height - scale * p.dot(up));
        draw_stroke(picture, at, at, 0.7 * digit, pixel_colour(role_colour(end.role)));
        if (end.number > 0)
            write_text(picture, at.x() + 0.5 * digit, at.y() - 0.4 * digit,
                       std::to_string(end.number), digit, kInk);
    }
}

std::vector<ReportPicture> report_pictures(const Surface& surface,
                                           const std::optional<PictureSource>& source,
                                           std::span<const EndMark> ends) {
    std::vector<ReportPicture> pictures;
    series_of_patches(surface).draw_into(pictures, surface, ends);
    if (source) series_of_deviation(surface, *source).draw_into(pictures, surface);
    if (source) series_of_source(*source, surface).draw_into(pictures, source->surface);
    return pictures;
}

std::vector<ReportPicture> measure_pictures(const Surface& surface,
                                            const std::vector<double>& values,
                                            const ColourScale& scale, const std::string& title) {
    Series series;
    series.add(title, colours_of(values, scale));
    const std::vector<Picture> drawn = draw_views(surface, series.views);
    std::vector<ReportPicture> pictures;
    for (std::size_t i = 0; i < drawn.size(); ++i)
        pictures.push_back({series.titles[i], png(with_scale(drawn[i], scale, title))});
    return pictures;
}

double deviation_of_full_colour(std::vector<double> deviations) {
    if (deviations.empty()) return 1.0;
    for (double& deviation : deviations) deviation = std::abs(deviation);
    const auto place =
        deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() * 49 / 50);
    std::ranges::nth_element(deviations, place);
    return std::max(*place, 1e-6);
}

std::vector<Colour> colours_of(const std::vector<double>& deviations, double full_colour) {
    std::vector<Colour> colours;
    for (const double deviation : deviations)
        colours.push_back(diverging_colour(deviation / full_colour));
    return colours;
}

DeviationColours deviation_colours(const Surface& surface, const Surface& source,
                                   const std::vector<std::uint8_t>& comparable,
                                   double full_colour) {
    std::vector<double> deviations = distance_to(source).signed_distances(surface.points());
    const auto counts = [&](std::size_t v) { return comparable.empty() || comparable[v] != 0; };
    std::vector<double> compared;
    for (std::size_t v = 0; v < deviations.size(); ++v)
        if (counts(v)) compared.push_back(deviations[v]);
    const double full =
        full_colour > 0.0 ? full_colour : deviation_of_full_colour(std::move(compared));
    for (std::size_t v = 0; v < deviations.size(); ++v)
        if (!counts(v)) deviations[v] = 0.0;
    return {colours_of(deviations, full), full};
}

std::string deviation_legend(double full_colour) {
    return formatted(full_colour, "blue %.2g mm inside, red outside");
}

}  // namespace vesselbench
