#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/render/drawn_surface.h"
#include "gpu/render/layers.h"
#include "workbench/session/task.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

/// The centerlines of a vessel tree, and circles of the local radius across them, about one local
/// radius apart.
[[nodiscard]] std::vector<Polyline> centerline_drawing(const CenterlineGraph& graph);

/// What is drawn over the model if it is chosen: the source as a wireframe, the centerlines, the
/// names of the openings and the places of the edits.
class OverlayLayers {
public:
    /// \param wake as Viewport's
    explicit OverlayLayers(std::function<void()> wake);

    /// Once a frame, before anything is drawn; needs the window's OpenGL context.
    void update(PanelContext& context);

    /// Counts changes of what add_to adds.
    [[nodiscard]] int version() const { return version_; }

    [[nodiscard]] bool pending() const { return source_search_.pending(); }

    void add_to(Layers& layers, double line_width, bool dark) const;

    /// Forgets what is shown: the case is closed.
    void forget();

    /// Names and places as marks in ImGui's current window.
    void draw_marks(PanelContext& context, const PixelView& screen) const;

private:
    void update_source(const PanelContext& context);
    void update_lines(const PanelContext& context);

    Task<DrawingArrays> source_search_;
    std::shared_ptr<const Positions> asked_source_;
    std::shared_ptr<DrawnSurface> source_;
    std::shared_ptr<const CenterlineGraph> graph_;  ///< that is drawn
    std::shared_ptr<const DrawnLines> lines_;
    std::vector<NamedPlace> anchors_;
    int seen_snapshots_ = -1;
    std::string seen_variant_;
    int version_ = 0;
};

}  // namespace vesselbench
