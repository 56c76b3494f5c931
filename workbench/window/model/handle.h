#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "gpu/render/view_camera.h"

namespace vesselbench {

/// A place in the view [pixels], from its upper left corner, y downwards.
using ViewPixel = Eigen::Vector2d;

/// A view of so many pixels: where points are seen, without any drawing.
struct PixelView {
    ViewCamera camera;
    double width = 1.0, height = 1.0;  ///< [pixels]

    [[nodiscard]] double aspect() const { return width / height; }

    /// None for a point behind the eye.
    [[nodiscard]] std::optional<ViewPixel> place(const Vec3& point) const;

    /// The line of points that are seen at a pixel.
    [[nodiscard]] Ray ray(const ViewPixel& pixel) const;

    /// Length that a pixel shows at a point [mm].
    [[nodiscard]] double pixel_at(const Vec3& point) const;
};

/// How a handle follows the cursor.
enum class HandlePath {
    Free,   ///< in the plane of the view
    Line,   ///< along `direction`
    Track,  ///< along the polyline `track`
    Ball    ///< around `pivot`, at a constant distance
};

enum class HandleLook { Dot, Square, Ring };

/// A place in the view that can be dragged to change a form.
struct Handle {
    std::string name;           ///< lasting: "crop.low.x"
    Vec3 point = Vec3::Zero();  ///< [mm]
    HandlePath path = HandlePath::Free;
    Vec3 direction = Vec3::UnitZ();  ///< unit
    Positions track;                 ///< [mm]
    Vec3 pivot = Vec3::Zero();       ///< [mm]
    HandleLook look = HandleLook::Dot;
    std::string help;  ///< what dragging it does
};

/// False for a handle on a line that is seen from its end.
[[nodiscard]] bool can_be_dragged(const Handle& handle, const PixelView& view);

/// The handle that can be dragged and is nearest to the cursor on the screen; of equal distances
/// the first. None if all are farther than `reach` [pixels].
[[nodiscard]] std::optional<std::size_t> nearest_handle(const std::vector<Handle>& handles,
                                                        const PixelView& view,
                                                        const ViewPixel& cursor, double reach);

/// Where a handle goes that is seen at a pixel, as far as its path allows [mm]. It stays if it
/// cannot be dragged.
[[nodiscard]] Vec3 dragged_point(const Handle& handle, const PixelView& view,
                                 const ViewPixel& pixel);

}  // namespace vesselbench
