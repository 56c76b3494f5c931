#include "workbench/window/drawing/pixel_view.h"

namespace vesselbench {

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

}  // namespace vesselbench
