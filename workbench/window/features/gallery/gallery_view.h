#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gpu/render/renderer.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/features/gallery/suggestion_gallery.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Width of the magnified spots in a view [pixels].
[[nodiscard]] float magnified_width(const ScreenRect& view);

/// The gallery of suggestions in the view: whole models in columns, seen by the view's camera; or
/// right of the model, the chosen spot magnified under each suggestion with the original's
/// triangles on top. Without a gallery it does nothing. Needs the window's OpenGL context.
class GalleryView {
public:
    /// \param wake called by other threads when update() has something to do
    explicit GalleryView(const std::function<void()>& wake);

    /// Follows the workplace's gallery; once a frame. \param view all of it
    void update(PanelContext& context, const ScreenRect& view);

    /// The case is closed.
    void forget();

    [[nodiscard]] bool is_on() const { return mode_ != GalleryMode::Off; }

    /// True if the models are drawn in place of the shown one.
    [[nodiscard]] bool hides_model() const { return mode_ == GalleryMode::Models; }

    /// True if a spot is magnified beside the model.
    [[nodiscard]] bool magnifies() const { return mode_ == GalleryMode::Spots; }

    /// The part of the view that is left for the shown model; of whole models the first one's.
    [[nodiscard]] ScreenRect room_for_model() const;

    /// Horizontal distance from a place to the same place in the first model's part [pixels].
    [[nodiscard]] float shift_to_model(float x) const;

    /// The suggestion in whose part the mouse is.
    [[nodiscard]] std::optional<std::size_t> cell_at_mouse() const;

    /// Magnifies the spot more, or less. \param notches of the wheel
    void zoom(double notches);

    /// Counts changes of what draw() draws.
    [[nodiscard]] int version() const { return version_; }

    [[nodiscard]] bool pending() const;

    /// Why a model cannot be drawn; empty: all can.
    [[nodiscard]] std::string problem() const;

    /// \param scene of the shown model \param look as the model is shown
    void draw(Renderer& renderer, const SceneView& scene, ViewLook look, double edge_width) const;

    /// What is seen where, with a button for each suggestion to take it.
    void draw_plates(PanelContext& context);

    /// A part of the view without the plates at its lower end [window's pixels].
    [[nodiscard]] ScreenRect above_plates(ScreenRect part) const;

private:
    void take_models(const SuggestionGallery& gallery);
    void take_original(const SuggestionGallery& gallery);
    void take_spot(const SuggestionGallery& gallery);
    [[nodiscard]] ScreenRect cell(std::size_t i) const;
    [[nodiscard]] PixelRectangle pixels_of(const ScreenRect& cell) const;
    [[nodiscard]] SceneView view_of(const SceneView& scene) const;
    [[nodiscard]] Layers layers_of(std::size_t i, const ViewLook& look, double edge_width,
                                   const SceneView& view) const;
    void draw_borders(PanelContext& context) const;
    [[nodiscard]] float draw_plate(PanelContext& context, const ScreenRect& cell,
                                   std::size_t i) const;

    GalleryMode mode_ = GalleryMode::Off;
    ScreenRect view_;
    std::array<ModelDrawing, SuggestionGallery::kCount> models_;
    std::array<std::shared_ptr<const PresetSuggestion>, SuggestionGallery::kCount> shown_;
    ModelDrawing original_;
    std::shared_ptr<const Surface> original_of_;
    double edge_ = 1.0;         ///< mean edge of the original [mm]
    std::optional<Spot> spot_;  ///< that is magnified
    double magnification_ = 1.0;
    float plates_ = 0.0F;  ///< height of the tallest one with its margins [pixels]
    int version_ = 0;
};

}  // namespace vesselbench
