#pragma once

#include <deque>
#include <functional>
#include <string>

#include "geometry/vessel/centerlines/vessel_diameter.h"
#include "gpu/render/pick.h"
#include "workbench/session/task.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/drawing/view_strips.h"
#include "workbench/window/features/picking/view_places.h"

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
        return picker_.pending() || search_.pending() || !clicks_.empty() || !places_.empty();
    }

    void draw_strip(PanelContext& context, ViewStrips& strips);

private:
    /// A click whose place is not searched yet.
    struct Click {
        SceneView view;
        Layers layers;
        Eigen::Vector2i pixel;  ///< of the view's framebuffer
    };

    void add_click(const SeenModel& seen);
    void search_click();
    void take(PanelContext& context, const Picked& picked);
    void search_diameter(const PanelContext& context);
    [[nodiscard]] std::string words(const PanelContext& context) const;

    Picker picker_;
    std::function<void()> wake_;
    Task<VesselDiameter> search_;
    MeasureTool tool_ = MeasureTool::None;
    int seen_scenes_ = -1;
    std::deque<Click> clicks_;
    std::deque<Vec3> places_;  ///< where diameters are still to be measured [mm]
};

}  // namespace vesselbench
