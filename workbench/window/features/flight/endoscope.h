#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/vessel/tree/flight_path.h"
#include "gpu/render/view_camera.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/view_strips.h"
#include "workbench/window/keys/key_table.h"

namespace vesselbench {

/// The endoscopic view (thesis Figs. 3.11, 5.17): a wide-angle camera on the centerline, which is
/// moved by a slider, the wheel and the arrow keys, or flies by itself; dragging looks around.
class Endoscope {
public:
    /// Once a frame. Takes the centerlines when they are known; flies on.
    /// \param seconds since the last frame
    void update(const PanelContext& context, double seconds);

    /// The camera in the lumen; none while it does not fly or the way is not known.
    [[nodiscard]] std::optional<ViewCamera> camera() const;

    /// True while it flies by itself, so that every frame is another one.
    [[nodiscard]] bool moves() const { return plays_ && path() != nullptr; }

    /// Turns the gaze [rad], as looked_round.
    void look_round(double right, double up);

    /// Back to the direction of the vessel.
    void look_ahead() { right_ = up_ = 0.0; }

    /// Moves by so many local radii.
    void advance(double radii);

    /// Keys of the flight.
    void handle_keys(const KeyCommands& keys);

    void draw_strip(PanelContext& context, ViewStrips& strips);

private:
    void find_paths(const PanelContext& context);
    [[nodiscard]] const FlightPath* path() const;
    void toggle_play();
    void draw_destination(PanelContext& context, float width);

    std::shared_ptr<const CenterlineGraph> graph_;  ///< whose paths these are
    std::vector<PatchMeasures> openings_;           ///< that name them
    std::vector<FlightPath> paths_;
    std::size_t chosen_ = 0;
    bool flies_ = false;
    bool plays_ = false;
    double abscissa_ = 0.0;          ///< [mm]
    double right_ = 0.0, up_ = 0.0;  ///< of the gaze [rad]
};

}  // namespace vesselbench
