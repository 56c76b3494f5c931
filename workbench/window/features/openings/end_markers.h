#pragma once

#include <optional>

#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/openings/end_rows.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The colour of what becomes of an end, as caps and pictures have it (role_colour).
[[nodiscard]] Paint end_colour(const Theme& theme, const EndRow& row);

/// The number of an end on a disc of its colour, drawn into ImGui's current window; one in doubt
/// has a ring.
void draw_end_badge(const Ui& ui, const ViewPixel& at, const EndRow& row, bool lit);

/// "End 3: diameter 5.2 mm, 34 % of the flow"
[[nodiscard]] std::string end_text(const EndRow& row);

/// The vessel ends of a form of clip-opening in the view: numbered markers, the planned cuts as
/// discs, and a card with the roles of the chosen end. A click on a marker opens or closes its end.
class EndMarkers {
public:
    /// Once a frame, before the view's other places are clicked.
    /// \param over the cursor is over the model and nothing else there
    /// \param clicked the left button was released without a drag
    /// \return true if the click was for a marker
    bool update(PanelContext& context, const PixelView& screen, bool over, bool clicked);

    void forget() { hot_.reset(); }

    /// True while the cursor is over a marker.
    [[nodiscard]] bool has_cursor() const { return hot_.has_value(); }

    void draw(PanelContext& context, const PixelView& screen) const;

    /// Over all other marks.
    void draw_card(PanelContext& context, const PixelView& screen) const;

private:
    std::optional<int> hot_;  ///< number of the end whose marker is under the cursor
};

}  // namespace vesselbench
