#pragma once

#include <memory>

#include "gpu/render/renderer.h"
#include "gpu/render/view_camera.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The 3D view in the window's centre, above the row of slices if that is shown: draws the shown
/// scene when something has changed, else the picture of the last time; turns, moves and zooms by
/// mouse and keys.
class Viewport {
public:
    /// Needs the window's OpenGL context, as draw() and the destructor do.
    /// \param wake called by other threads when a frame should be drawn
    explicit Viewport(std::function<void()> wake);
    ~Viewport();

    Viewport(const Viewport&) = delete;
    Viewport& operator=(const Viewport&) = delete;

    void draw(PanelContext& context, const ScreenRect& whole);

    /// The part of the whole that shows the model: slices may take the rest.
    [[nodiscard]] static ScreenRect model_part(const PanelContext& context,
                                               const ScreenRect& whole);

    /// In place of draw() while no case is open: forgets the last one, and frees what it had on the
    /// device.
    void rest(PanelContext& context);

    /// True while the shown scene is not drawn yet, or a search under the cursor runs.
    [[nodiscard]] bool pending() const;

    [[nodiscard]] const ViewCamera& camera() const;

    /// For other pictures in the same context.
    [[nodiscard]] Renderer& renderer();

    /// Number of times that the scene was drawn, for tests of idle windows.
    [[nodiscard]] int drawings() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
