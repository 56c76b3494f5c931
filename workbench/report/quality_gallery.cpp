#include "workbench/report/quality_gallery.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/wording.h"
#include "workbench/report/label_text.h"
#include "workbench/report/report_pictures.h"

namespace vesselbench {

namespace {

constexpr int kCell = 460, kGap = 10, kHead = 56, kFoot = 84, kLine = 22;
constexpr double kText = 13.0;
const Colour kInside(0.25F, 0.25F, 0.25F);  // red means outside here

Picture blank(int width, int height) {
    return {width, height,
            std::vector<std::uint8_t>(
                3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255)};
}

void paste(Picture& page, const Picture& picture, int left, int top) {
    for (int y = 0; y < picture.height; ++y) {
        const auto* row = picture.rgb.data() + 3 * static_cast<std::size_t>(y * picture.width);
        std::copy_n(row, 3 * static_cast<std::size_t>(picture.width),
                    page.rgb.data() + 3 * static_cast<std::size_t>((top + y) * page.width + left));
    }
}

/// Looks along the shortest side of the model, which shows as much of it as possible.
Vec3 sight(const Surface& surface) {
    const Bounds box = bounds(surface);
    const Vec3 size = box.max - box.min;
    if (size.x() < size.y() && size.x() < size.z()) return {-1, 0, 0};
    return size.z() < 0.6 * size.y() ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
}

/// The place with the largest mean deviation of a vertex and its neighbours, away from open
/// rims.
VertexId most_changed(const Surface& surface, const std::vector<double>& deviations) {
    const CompressedRows& rings = surface.topology->rings();
    const auto& rim = surface.topology->boundary_vertices();
    VertexId best = 0;
    double largest = -1.0;
    for (VertexId v = 0; v < deviations.size(); ++v) {
        double sum = std::abs(deviations[v]);
        bool near_rim = rim[v] != 0;
        for (const VertexId u : rings.row(v)) {
            sum += std::abs(deviations[u]);
            near_rim = near_rim || rim[u] != 0;
        }
        sum /= 1.0 + static_cast<double>(rings.row(v).size());
        if (near_rim || sum <= largest) continue;
        largest = sum;
        best = v;
    }
    return best;
}

/// The vertex of the original nearest to a place.
VertexId nearest(const Surface& surface, const Vec3& at) {
    VertexId best = 0;
    for (VertexId v = 0; v < surface.vertex_count(); ++v)
        if ((surface.points()[v] - at).squaredNorm() < (surface.points()[best] - at).squaredNorm())
            best = v;
    return best;
}

/// Camera on a vertex of the original, from outside, so close that its edges can be distinguished.
PictureOptions magnified(const std::shared_ptr<const Surface>& frame, VertexId v) {
    const Surface& original = *frame;
    constexpr double kEdgesAcross = 22.0;
    PictureOptions options{.width = kCell, .height = kCell};
    Vec3 normal = vertex_normals(original)[v];
    if (!(normal.norm() > 0.5)) normal = Vec3(0, -1, 0);
    options.view = -normal;
    options.up = upward_for(options.view);
    options.shift = original.points()[v] - bounds(original).centre();
    options.frame = frame;
    options.half_height = 0.5 * kEdgesAcross * mean_edge_length(original);
    return options;
}

std::string millimetres(double value) {
    return value == 0.0 ? "0" : formatted(value, "%+.2g");
}

void add_scale(Picture& page, double full) {
    const int left = page.width / 2 - 200, top = page.height - kFoot + 30;
    for (int x = 0; x < 400; ++x) {
        const PixelColour colour = pixel_colour(diverging_colour(x / 199.5 - 1.0));
        draw_stroke(page, {left + x + 0.5, top}, {left + x + 0.5, top + 14.0}, 1.2, colour);
    }
    for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const double x = left + 200.0 * (share + 1.0);
        draw_stroke(page, {x, top + 16.0}, {x, top + 21.0}, 1.2, {34, 34, 34});
        const std::string text = millimetres(share * full);
        write_text(page, x - 0.5 * text_width(text, kText), top + 40.0, text, kText);
    }
    const std::string words =
        "deviation from the original [mm]: blue inside, red outside (full colours: or more)";
    write_text(page, 0.5 * (page.width - text_width(words, kText)), top - 12.0, words, kText);
}

}  // namespace

Picture quality_gallery(const Surface& original, const std::vector<GalleryModel>& models,
                        const std::string& title, const std::optional<Vec3>& at) {
    const auto count = static_cast<int>(models.size());
    std::size_t most_lines = 0;
    for (const GalleryModel& model : models)
        most_lines = std::max(most_lines, model.captions.size());
    const int caption = kLine * (static_cast<int>(most_lines) + 1);
    Picture page = blank(count * (kCell + kGap) + kGap, kHead + 2 * kCell + caption + kFoot);
    const SurfaceDistance distance = distance_to(original);
    std::vector<std::vector<double>> deviations;
    for (const GalleryModel& model : models)
        deviations.push_back(distance.signed_distances(model.surface.points()));
    // The middle model determines the scale: strong changes would make the others pale.
    std::vector<double> fulls;
    for (const auto& one : deviations) fulls.push_back(deviation_of_full_colour(one));
    std::ranges::sort(fulls);
    const double full = fulls[fulls.size() / 2];
    const std::size_t middle = models.size() / 2;
    const Surface& shown = models[middle].surface;
    const VertexId place =
        nearest(original, at ? *at : shown.points()[most_changed(shown, deviations[middle])]);
    const auto frame = std::make_shared<const Surface>(original);
    const Vec3 view = sight(original);
    PictureOptions near = magnified(frame, place);
    near.back = kInside;
    write_text(page, 2.0 * kGap, 34.0, title, 17.0);
    for (int i = 0; i < count; ++i) {
        const GalleryModel& model = models[static_cast<std::size_t>(i)];
        const auto colours = colours_of(deviations[static_cast<std::size_t>(i)], full);
        const int left = kGap + i * (kCell + kGap);
        paste(page,
              draw(model.surface, {.width = kCell,
                                   .height = kCell,
                                   .view = view,
                                   .up = upward_for(view),
                                   .vertex_colours = colours,
                                   .back = kInside,
                                   .frame = frame}),
              left, kHead);
        double y = kHead + kCell + 20.0;
        for (const std::string& line : model.captions) {
            write_text(page, left + 8.0, y, line, kText);
            y += kLine;
        }
        near.vertex_colours = colours;
        near.wires = std::ranges::equal(model.surface.triangles(), original.triangles())
                         ? frame
                         : std::make_shared<const Surface>(model.surface);
        paste(page, draw(model.surface, near), left, kHead + kCell + caption);
    }
    add_scale(page, full);
    return page;
}

}  // namespace vesselbench
