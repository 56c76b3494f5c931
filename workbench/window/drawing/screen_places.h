#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "workbench/window/case/surface_places.h"
#include "workbench/window/drawing/handle.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A camera's view in a rectangle of the window.
[[nodiscard]] PixelView on_screen(const ViewCamera& camera, const ScreenRect& rect);

[[nodiscard]] ScreenRect rect_of(const PixelView& view);

/// A pixel, as an item's rectangle.
[[nodiscard]] ScreenRect spot_rect(const ViewPixel& at);

/// Where the mouse is.
[[nodiscard]] ViewPixel mouse_pixel();

/// A view's picture, whose first row is the lowest, into ImGui's current window.
void draw_texture(unsigned texture, const ScreenRect& rect);

/// The place whose mark is nearest to a cursor; none within `reach` [pixels].
[[nodiscard]] std::optional<std::size_t> nearest_mark(const PixelView& screen,
                                                      const std::vector<NamedPlace>& places,
                                                      const ViewPixel& cursor, double reach);

/// True if the cursor may be over one of the openings: a quick test before a search.
[[nodiscard]] bool may_be_over(const PixelView& screen, const std::vector<PatchMeasures>& openings,
                               const ViewPixel& cursor);

/// How a place is marked.
enum class MarkLook {
    Offered,  ///< it may be picked
    Lit,      ///< a click would pick it
    Picked
};

/// A disc, with a label beside it unless that is empty, drawn into ImGui's current window.
void draw_mark(const Ui& ui, const ViewPixel& at, MarkLook look, const std::string& label);

/// A line through the points that are before the eye, drawn into ImGui's current window.
/// \param closed back to its first point
void draw_mark_line(const Ui& ui, const PixelView& screen, std::span<const Vec3> points,
                    bool closed);

inline constexpr float kClickReach = 0.3F;    ///< the mouse may move so far in a click [em]
inline constexpr double kHandleReach = 0.85;  ///< a cursor so near to a handle is over it [em]
inline constexpr Paint kRegionPaint = paint(0xE07A10);  ///< of handles, and of regions in slices

/// A handle, drawn into ImGui's current window and registered by its name.
void draw_handle_mark(Ui& ui, const Handle& handle, const ViewPixel& at, bool lit);

/// Text on a plate, from the middle of its left side; moved so that it is inside the window.
void draw_plate(const Ui& ui, const ViewPixel& at, const std::string& words);

/// A line of text in the lower middle of the view.
void draw_hint(const Ui& ui, const ScreenRect& view, const std::string& words);

}  // namespace vesselbench
