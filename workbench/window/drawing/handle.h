#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/window/drawing/pixel_view.h"

namespace vesselbench {

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
