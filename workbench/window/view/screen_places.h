#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/render/view_camera.h"
#include "workbench/window/model/surface_places.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Where points are seen in the window.
struct OnScreen {
    ViewCamera camera;
    ScreenRect rect;  ///< of the view

    [[nodiscard]] double aspect() const { return rect.height > 0 ? rect.width / rect.height : 1; }

    /// [pixels] of the window; none for a point behind the eye.
    [[nodiscard]] std::optional<Eigen::Vector2f> place(const Vec3& point) const;

    /// [pixels] that a length at a point takes.
    [[nodiscard]] double length(const Vec3& point, double millimetres) const;
};

/// The place whose mark is nearest to a cursor; none within `reach` [pixels].
[[nodiscard]] std::optional<std::size_t> nearest_mark(const OnScreen& screen,
                                                      const std::vector<NamedPlace>& places,
                                                      const Eigen::Vector2f& cursor, float reach);

/// True if the cursor may be over one of the openings: a quick test before a search.
[[nodiscard]] bool may_be_over(const OnScreen& screen, const std::vector<PatchMeasures>& openings,
                               const Eigen::Vector2f& cursor);

/// How a place is marked.
enum class MarkLook {
    Offered,  ///< it may be picked
    Lit,      ///< a click would pick it
    Picked
};

/// A disc, with a label beside it unless that is empty, drawn into ImGui's current window.
void draw_mark(const Ui& ui, const Eigen::Vector2f& at, MarkLook look, const std::string& label);

/// Text on a plate, from the middle of its left side; moved so that it is inside the window.
void draw_plate(const Ui& ui, const Eigen::Vector2f& at, const std::string& words);

/// A line of text in the lower middle of the view.
void draw_hint(const Ui& ui, const ScreenRect& view, const std::string& words);

}  // namespace vesselbench
