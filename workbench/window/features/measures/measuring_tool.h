#pragma once

#include <deque>
#include <functional>
#include <string>

#include "geometry/vessel/centerlines/vessel_diameter.h"
#include "workbench/session/task.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/drawing/view_strips.h"
#include "workbench/window/features/picking/clicked_places.h"

namespace vesselbench {

/// Measures by clicks on the surface: distances from click to click, and diameters of vessels. What
/// was measured is kept in the workplace's list.
class MeasuringTool {
public:
    /// \param renderer must outlive it \param wake as Viewport's
    MeasuringTool(Renderer& renderer, std::function<void()> wake);

    /// Once a frame, before the model is drawn.
    void update(PanelContext& context, const SeenModel& seen);

    /// Drops what is being measured.
    void forget();

    /// True while a search runs.
    [[nodiscard]] bool pending() const {
        return clicks_.pending() || search_.pending() || !places_.empty();
    }

    void draw_strip(PanelContext& context, ViewStrips& strips);

private:
    void take(PanelContext& context, const Vec3& place);
    void search_diameter(const PanelContext& context);
    [[nodiscard]] std::string words(const PanelContext& context) const;

    ClickedPlaces clicks_;
    Task<VesselDiameter> search_;
    ClickTool tool_ = ClickTool::None;
    int seen_scenes_ = -1;
    std::deque<Vec3> places_;  ///< where diameters are still to be measured [mm]
};

}  // namespace vesselbench
