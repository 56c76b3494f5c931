#include "workbench/window/drawing/pixel_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace vesselbench {

namespace {

/// From above to below, then the same farther off.
std::vector<ViewPixel> places_around(const ViewPixel& middle, double off) {
    std::vector<ViewPixel> places;
    for (const double reach : {off, 2.0 * off})
        for (const double eighths : {0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0}) {
            const double turn = eighths * std::numbers::pi / 4.0;
            places.emplace_back(middle.x() + reach * std::sin(turn),
                                middle.y() - reach * std::cos(turn));
        }
    return places;
}

}  // namespace

std::optional<ViewPixel> PixelView::place(const Vec3& point) const {
    const auto seen = project(camera, aspect(), point);
    if (!seen) return std::nullopt;
    return ViewPixel(left + width * (0.5 + 0.5 * seen->x()),
                     top + height * (0.5 - 0.5 * seen->y()));
}

Eigen::Vector2d PixelView::ndc(const ViewPixel& pixel) const {
    return {2.0 * (pixel.x() - left) / width - 1.0, 1.0 - 2.0 * (pixel.y() - top) / height};
}

Eigen::Vector2d PixelView::ndc_move(const ViewPixel& move) const {
    return {2.0 * move.x() / width, -2.0 * move.y() / height};
}

Eigen::Vector2i PixelView::device_pixel(const ViewPixel& pixel) const {
    return {static_cast<int>(pixel.x() - left), static_cast<int>(height - 1.0 - (pixel.y() - top))};
}

Ray PixelView::ray(const ViewPixel& pixel) const {
    return ray_through(camera, aspect(), ndc(pixel));
}

double PixelView::pixel_at(const Vec3& point) const {
    return pixel_size(camera, static_cast<int>(height), point);
}

double PixelView::length(const Vec3& point, double millimetres) const {
    return millimetres / pixel_at(point);
}

std::optional<std::size_t> nearest_to(const ViewPixel& cursor,
                                      std::span<const std::optional<ViewPixel>> places,
                                      double reach) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i]) continue;
        const double distance = (*places[i] - cursor).norm();
        if (distance > reach || (nearest && distance >= reach)) continue;
        reach = distance;
        nearest = i;
    }
    return nearest;
}

std::vector<std::optional<ViewPixel>> marks_apart(const PixelView& view,
                                                  std::span<const std::optional<ViewPixel>> marked,
                                                  double off, double size) {
    const Eigen::AlignedBox2d room(
        ViewPixel(view.left + size / 2, view.top + size / 2),
        ViewPixel(view.left + view.width - size / 2, view.top + view.height - size / 2));
    std::vector<std::optional<ViewPixel>> marks;
    for (const auto& place : marked) {
        std::optional<ViewPixel>& mark = marks.emplace_back();
        if (!place) continue;
        const std::vector<ViewPixel> candidates = places_around(*place, off);
        const std::span<const std::optional<ViewPixel>> others(marks.data(), marks.size() - 1);
        const auto inside = [&](const ViewPixel& at) { return room.contains(at); };
        const auto free = [&](const ViewPixel& at) {
            return inside(at) && !nearest_to(at, others, size);
        };
        auto chosen = std::ranges::find_if(candidates, free);
        if (chosen == candidates.end()) chosen = std::ranges::find_if(candidates, inside);
        mark = chosen == candidates.end() ? candidates.front() : *chosen;
    }
    return marks;
}

}  // namespace vesselbench
