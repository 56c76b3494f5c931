#pragma once

#include <functional>

#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/drawing/view_strips.h"
#include "workbench/window/features/picking/clicked_places.h"

namespace vesselbench {

/// Clicks on the surface that place the pins and distances of a reviewer.
class ReviewClicks {
public:
    /// \param renderer must outlive it \param wake as Viewport's
    ReviewClicks(Renderer& renderer, std::function<void()> wake)
        : clicks_(renderer, std::move(wake)) {}

    /// Once a frame, before the model is drawn.
    void update(PanelContext& context, const SeenModel& seen);

    /// Drops clicks whose place is searched.
    void forget() { clicks_.forget(); }

    /// True while a place is searched.
    [[nodiscard]] bool pending() const { return clicks_.pending(); }

    /// What the next click places.
    void draw_strip(PanelContext& context, ViewStrips& strips) const;

private:
    ClickedPlaces clicks_;
    ClickTool tool_ = ClickTool::None;
    int seen_scenes_ = -1;
};

}  // namespace vesselbench
