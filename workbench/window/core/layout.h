#pragma once

#include <optional>
#include <vector>

#include "workbench/window/core/panel_sizes.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A line between two parts of the window, by which one of them is resized.
struct Border {
    Panel panel = Panel::Rail;  ///< that is resized
    ScreenRect rect;
    /// The panel's share is the mouse's way from `from` to `to`, along x or y [pixels].
    float from = 0, to = 1;
    bool upright = true;  ///< the mouse moves along x
};

/// Where the parts of the window are. A folded one has no width or height.
struct Layout {
    ScreenRect window, tool_bar, rail, view, bottom, operation, status;
    std::vector<Border> borders;
    bool compact = false;  ///< little room: short labels
};

/// \param width, height of the window [pixels] \param em size of the text [pixels]
/// \param sizes limited so that every part, and the view between them, keeps room
[[nodiscard]] Layout layout_of(float width, float height, float em, const PanelSizes& sizes = {});

/// Width of a border [pixels].
[[nodiscard]] float border_width(float em);

/// Of the view: the part of the model, and that of the slices below or around it.
struct ViewParts {
    ScreenRect model;
    ScreenRect slices;  ///< all of them with their header, but the one beside the model
    std::optional<ScreenRect> beside;  ///< in quarters: of the first slice
    std::optional<Border> border;
};

/// \param view all of it \param enlarged a slice has the model at its side
[[nodiscard]] ViewParts view_parts(const ScreenRect& view, float em, const PanelSizes& sizes,
                                   Enlarged enlarged = Enlarged::None);

}  // namespace vesselbench
