#pragma once

#include <functional>
#include <optional>

#include "gpu/render/renderer.h"
#include "gpu/render/target.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/drawing_guard.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/drawing/region_drawing.h"
#include "workbench/window/features/clip/clip_section.h"
#include "workbench/window/features/compare/comparison_view.h"
#include "workbench/window/features/gallery/gallery_view.h"
#include "workbench/window/features/slices/slice_planes.h"
#include "workbench/window/view/branch_highlight.h"
#include "workbench/window/view/overlay_layers.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// All that the 3D view draws of a case, and the picture of it, which is drawn again when something
/// has changed. Needs the window's OpenGL context.
class ViewScene {
public:
    /// \param wake as Viewport's \param guard must outlive it
    ViewScene(const std::function<void()>& wake, DrawingGuard& guard);

    /// Where the camera has to look after update().
    enum class Change {
        None,
        Model,  ///< another surface is shown; always while an image without one is
        Room    ///< the view's part that shows the model has another size
    };

    /// Follows the shown scene and what is compared; once a frame, first.
    /// \param area all of the view
    [[nodiscard]] Change update(PanelContext& context, const ScreenRect& area);

    /// What is chosen to be seen with the model.
    struct Choices {
        const std::vector<RegionLine>& lines;    ///< of the form
        std::optional<Vec3> spot;                ///< the place under the cursor [mm]
        std::optional<std::uint32_t> lit_patch;  ///< label of the opening under the cursor
    };

    /// \param inside the camera is in the lumen
    void look_from(const ViewCamera& camera, bool inside);

    /// Once a frame, before draw().
    void choose(PanelContext& context, const Choices& choices);

    /// The case is closed: forgets it, and frees what it has on the device.
    void forget(PanelContext& context);

    [[nodiscard]] bool pending() const;

    // --- what is shown

    /// The drawn surface; null: none.
    [[nodiscard]] const Surface* surface() const { return model_.surface(); }

    /// Counts changes of the drawn surface.
    [[nodiscard]] int version() const { return models_; }

    /// Whether there is anything to look at.
    [[nodiscard]] bool has_content() const {
        return surface() != nullptr || planes_.any_in_space();
    }

    /// Of the image's planes that are shown; none: no plane is.
    [[nodiscard]] const std::optional<Bounds>& image_box() const { return image_box_; }

    /// The part of the view that shows the model.
    [[nodiscard]] const ScreenRect& rect() const { return rect_; }

    /// From a place of the view to where the shown model would be seen there [pixels]: not 0 over
    /// the reference of a comparison, or over the gallery's further models.
    [[nodiscard]] float shift_at(float x) const {
        return gallery_.is_on() ? gallery_.shift_to_model(x) : compared_.shift_to_model(area_, x);
    }

    /// True if others are drawn in place of the shown model.
    [[nodiscard]] bool hides_model() const {
        return compared_.hides_model() || gallery_.hides_model();
    }

    [[nodiscard]] const ModelDrawing& model() const { return model_; }

    [[nodiscard]] const ComparisonView& compared() const { return compared_; }

    [[nodiscard]] const GalleryView& gallery() const { return gallery_; }

    [[nodiscard]] GalleryView& gallery() { return gallery_; }

    [[nodiscard]] const ClipSection& clip() const { return clip_; }

    [[nodiscard]] const OverlayLayers& overlays() const { return overlays_; }

    [[nodiscard]] const SlicePlanes& planes() const { return planes_; }

    /// As the model is shown now.
    [[nodiscard]] ViewLook model_look() const;

    // --- drawing

    [[nodiscard]] Layers layers(const Ui& ui) const;
    [[nodiscard]] SceneView scene_view(const Ui& ui) const;

    /// Draws if anything has changed. \return the picture's texture; 0: it cannot be drawn
    [[nodiscard]] unsigned draw(Renderer& renderer, const Ui& ui);

    /// True if the view shows the model, and no other one in its place or beside it.
    [[nodiscard]] bool shows_model_alone() const {
        return !hides_model() && !gallery_.is_on() && rect_.width == area_.width;
    }

    /// The model drawn again, without marks and legend. Needs the window's OpenGL context.
    /// \param factor times the view's size \param background none: the theme's
    /// \throw GpuUnavailable if the device cannot draw this size
    [[nodiscard]] Picture picture(Renderer& renderer, const Ui& ui, int factor,
                                  const std::optional<Colour>& background) const;

    /// True once it was drawn.
    [[nodiscard]] bool is_drawn() const { return target_.has_value(); }

    /// Number of times that it was drawn.
    [[nodiscard]] int drawings() const { return drawings_; }

private:
    /// All that the picture depends on besides the model.
    struct DrawnAs {
        ViewCamera camera;
        ViewLook look;
        int width = 0, height = 0;
        bool dark = false;
        std::optional<std::uint32_t> lit_patch;
        int region = 0;    ///< version of the form's lines
        int branch = 0;    ///< version of the highlight
        int slices = 0;    ///< version of the image's planes
        int compared = 0;  ///< version of the comparison's reference
        int gallery = 0;   ///< version of the suggestions
        ValueRange range;
        int clip = 0;      ///< version of the clip plane and its section
        int overlays = 0;  ///< version of theirs
        bool inside = false;

        bool operator==(const DrawnAs&) const = default;
    };

    [[nodiscard]] bool take_room(PanelContext& context, const ScreenRect& area);
    [[nodiscard]] bool take_model(PanelContext& context);
    void choose_colours(PanelContext& context);
    void take_planes(PanelContext& context);
    [[nodiscard]] DrawnAs now(const Ui& ui) const;
    [[nodiscard]] bool is_hurried();
    [[nodiscard]] bool turns() const;
    [[nodiscard]] Layers layers_as(const ViewLook& look, const Ui& ui) const;
    void draw_picture(Renderer& renderer, const Ui& ui);

    DrawingGuard& guard_;
    ModelDrawing model_;
    ComparisonView compared_;
    GalleryView gallery_;
    BranchHighlight branch_;
    ClipSection clip_;
    OverlayLayers overlays_;
    RegionDrawing region_;
    SlicePlanes planes_;
    std::optional<Bounds> image_box_;
    ViewLook look_;
    ScreenRect area_;  ///< all of the view
    ScreenRect rect_;  ///< the part of it that shows the model
    ViewCamera camera_;
    bool inside_ = false;
    std::optional<std::uint32_t> lit_patch_;
    int seen_scenes_ = -1;
    std::shared_ptr<const LiveModel> live_;    ///< that is smoothed; null: none
    std::shared_ptr<const Surface> followed_;  ///< shown instead of the document's; null: none
    int models_ = 0;
    std::optional<RenderTarget> target_;
    unsigned texture_ = 0;
    std::optional<DrawnAs> drawn_;
    int samples_ = 0;                  ///< of the picture
    std::optional<bool> in_software_;  ///< none: not asked yet
    int drawings_ = 0;
};

}  // namespace vesselbench
