#pragma once

#include <optional>
#include <string>

#include "gpu/colours.h"
#include "gpu/render/view_camera.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A length of 1, 2 or 5 times a power of ten, and its text.
struct ScaleLength {
    double millimetres = 0.0;
    std::string text;  ///< "5 mm"
};

/// The longest such length that is at most `most` [mm].
[[nodiscard]] ScaleLength scale_length(double most);

/// A bar in the lower right corner of the view.
void draw_scale_bar(const Ui& ui, const ScreenRect& view, const ViewCamera& camera);

/// The patient's axes in the lower left corner: L and R, A and P, S and I. A click on a letter
/// looks from there. \return the side that was clicked
[[nodiscard]] std::optional<StandardView> draw_orientation(Ui& ui, const ScreenRect& view,
                                                           const ViewCamera& camera);

/// Where the axes and their letters are.
[[nodiscard]] ScreenRect orientation_rect(const Ui& ui, const ScreenRect& view);

/// The most buttons in the view's upper left corner.
inline constexpr int kViewTools = 8;

/// Where they are, in as many rows as a narrow view asks for.
struct ToolGrid {
    ScreenRect rect;  ///< of the plate under them
    int columns = 1;
};

[[nodiscard]] ToolGrid tool_grid(const Ui& ui, const ScreenRect& view, int buttons = kViewTools);

/// The meaning of a colour map.
struct ColourLegend {
    ColourMap map = ColourMap::Ordered;
    double least = 0.0, most = 1.0;  ///< values at its ends
    std::string title;               ///< with the unit
    std::string remark;              ///< under it: "3 % above the range"; may be empty
};

inline constexpr float kLegendWidth = 17.0F, kLegendHeight = 7.5F;  ///< with its margins [em]

/// The colours with their values, in the upper right corner. \return where they are
ScreenRect draw_colour_legend(const Ui& ui, const ScreenRect& view, const ColourLegend& legend);

}  // namespace vesselbench
