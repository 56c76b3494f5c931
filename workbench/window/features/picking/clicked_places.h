#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "gpu/render/pick.h"
#include "workbench/window/features/picking/view_places.h"

namespace vesselbench {

/// The places of the model that clicks hit, found in the order of the clicks without waiting for
/// the device.
class ClickedPlaces {
public:
    /// \param renderer must outlive it \param wake as Viewport's
    ClickedPlaces(Renderer& renderer, std::function<void()> wake);

    /// A click at the mouse's place, in this frame.
    void add(const SeenModel& seen);

    /// Once a frame. \return the next place that was found [mm]; none: not yet, or the click has
    /// missed the model
    [[nodiscard]] std::optional<Vec3> update();

    /// Drops all clicks.
    void forget();

    /// True while a click's place is searched.
    [[nodiscard]] bool pending() const { return picker_.pending() || !clicks_.empty(); }

private:
    /// A click whose place is not searched yet.
    struct Click {
        SceneView view;
        Layers layers;
        Eigen::Vector2i pixel;  ///< of the view's framebuffer
    };

    void search();

    Picker picker_;
    std::function<void()> wake_;
    std::deque<Click> clicks_;
};

}  // namespace vesselbench
