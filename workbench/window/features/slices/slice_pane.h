#pragma once

#include <optional>

#include "gpu/render/renderer.h"
#include "gpu/render/target.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/panel_sizes.h"
#include "workbench/window/drawing/drawing_guard.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/features/slices/slice_crop.h"
#include "workbench/window/features/slices/slice_planes.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// A camera that shows all of a slice.
[[nodiscard]] ViewCamera slice_camera(const SliceGrid& grid, SlicePlane plane, double position,
                                      double aspect);

/// The state of the window in which the slice of a plane is enlarged.
[[nodiscard]] Enlarged enlarged_as(SlicePlane plane);

/// What the 2D views share.
struct PaneSource {
    Renderer& renderer;
    const SlicePlanes& planes;
    DrawingGuard& guard;
};

/// A slice as a 2D view: letters of the sides, position, scale, and the lines of the other planes.
/// Click or drag moves the cross there; a click gives its place to the armed parameter, or measures
/// a distance while that tool is on; a double click enlarges the slice, or ends that; where a form
/// crops, a drag draws the box; right drag changes window and level; the wheel goes through the
/// slices, with Ctrl it zooms.
class SlicePane {
public:
    explicit SlicePane(SlicePlane plane) : plane_(plane), crop_(plane) {}

    /// Needs the window's OpenGL context, as the destructor does.
    void draw(PanelContext& context, const PaneSource& source, const ScreenRect& rect);

    [[nodiscard]] SlicePlane plane() const { return plane_; }

    /// The place under the cursor [mm].
    [[nodiscard]] const std::optional<Vec3>& pointed() const { return pointed_; }

private:
    /// All that the picture depends on.
    struct Drawn {
        ViewCamera camera;
        int version = 0, width = 0, height = 0;

        bool operator==(const Drawn&) const = default;
    };

    void place_camera(const ImageSlices& slices);
    void handle_mouse(PanelContext& c);
    void handle_wheel(PanelContext& c);
    void handle_drag(PanelContext& c);
    void handle_click(PanelContext& c);
    void draw_picture(const Ui& ui, const PaneSource& source);
    void draw_cross(const Ui& ui, const ImageSlices& slices) const;
    void draw_texts(PanelContext& c, const Ui& ui) const;
    void draw_marks(const PanelContext& c, const Ui& ui) const;
    void draw_switch(PanelContext& c) const;
    void draw_slider(PanelContext& c, const ScreenRect& rect) const;
    [[nodiscard]] PixelView screen() const;
    [[nodiscard]] Vec3 place_of(const ViewPixel& pixel) const;

    SlicePlane plane_;
    SliceCrop crop_;
    std::optional<RenderTarget> target_;
    unsigned texture_ = 0;
    std::optional<Drawn> drawn_;
    ViewCamera camera_;
    bool fits_ = true;  ///< until the user zooms or moves it
    SliceGrid grid_;    ///< that the camera was set for
    ScreenRect rect_;   ///< of the picture
    float turned_ = 0;  ///< the wheel, since the last slice [notches]
    std::optional<Vec3> pointed_;
};

}  // namespace vesselbench
