#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "gpu/render/view_camera.h"

namespace vesselbench {

/// A place in the window [pixels], from its upper left corner, y downwards.
using ViewPixel = Eigen::Vector2d;

/// A view of so many pixels in the window: where points are seen, without any drawing.
struct PixelView {
    ViewCamera camera;
    double width = 1.0, height = 1.0;  ///< [pixels]
    double left = 0.0, top = 0.0;      ///< of its upper left corner [pixels]

    [[nodiscard]] double aspect() const { return height > 0.0 ? width / height : 1.0; }

    /// None for a point behind the eye.
    [[nodiscard]] std::optional<ViewPixel> place(const Vec3& point) const;

    /// A place as the camera's functions take it.
    [[nodiscard]] Eigen::Vector2d ndc(const ViewPixel& pixel) const;

    /// A move of the mouse in the same unit.
    [[nodiscard]] Eigen::Vector2d ndc_move(const ViewPixel& move) const;

    /// The pixel of the view's framebuffer, from its lower left corner.
    [[nodiscard]] Eigen::Vector2i device_pixel(const ViewPixel& pixel) const;

    /// The line of points that are seen at a pixel.
    [[nodiscard]] Ray ray(const ViewPixel& pixel) const;

    /// Length that a pixel shows at a point [mm].
    [[nodiscard]] double pixel_at(const Vec3& point) const;

    /// [pixels] that a length at a point takes.
    [[nodiscard]] double length(const Vec3& point, double millimetres) const;
};

/// The place that is nearest to a cursor; of equal distances the first. None if all are farther
/// than `reach` [pixels], or not seen.
[[nodiscard]] std::optional<std::size_t> nearest_to(
    const ViewPixel& cursor, std::span<const std::optional<ViewPixel>> places, double reach);

/// Places of marks that stand off what they mark, so that none lies on another or outside the view:
/// above if that is free, else around it. The first ones choose first.
/// \param off from the middle of a mark to what it marks [pixels]
/// \param size of a mark [pixels]
[[nodiscard]] std::vector<std::optional<ViewPixel>> marks_apart(
    const PixelView& view, std::span<const std::optional<ViewPixel>> marked, double off,
    double size);

}  // namespace vesselbench
