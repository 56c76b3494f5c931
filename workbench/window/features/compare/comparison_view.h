#pragma once

#include <functional>

#include "gpu/render/renderer.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/features/compare/comparison.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The reference of a comparison in the view: left of the shown model, or in turn with it. Without
/// a comparison it does nothing. Needs the window's OpenGL context.
class ComparisonView {
public:
    /// \param wake called by other threads when update() has something to do
    explicit ComparisonView(std::function<void()> wake) : model_(std::move(wake)) {}

    /// Follows the workplace's comparison; once a frame.
    void update(PanelContext& context);

    /// Ends what is shown of a comparison.
    void forget();

    /// The part of the view that is left for the shown model.
    [[nodiscard]] ScreenRect room_for_model(const ScreenRect& view) const;

    /// Horizontal distance from a place to the same place in the shown model's part [pixels]: not 0
    /// over the reference.
    [[nodiscard]] float shift_to_model(const ScreenRect& view, float x) const;

    /// True if the reference is drawn in place of the shown model.
    [[nodiscard]] bool hides_model() const { return hides_model_; }

    /// True if the shown model is to be coloured by difference(), even while that is unknown.
    [[nodiscard]] bool colours_model() const { return mode_ == CompareMode::Deviation; }

    [[nodiscard]] const std::shared_ptr<const DeviationMap>& difference() const {
        return difference_;
    }

    /// Why the reference cannot be drawn; empty: it can.
    [[nodiscard]] const std::string& problem() const { return model_.problem(); }

    /// Counts changes of what draw() draws.
    [[nodiscard]] int version() const { return version_; }

    [[nodiscard]] bool pending() const { return model_.pending(); }

    /// Draws the reference where it belongs, after the shown model. \param view of the shown model
    void draw(Renderer& renderer, SceneView view, const ViewLook& look, double edge_width) const;

    /// What is seen where.
    void draw_labels(const Ui& ui, const ScreenRect& view) const;

private:
    void take(PanelContext& context, Comparison& comparison);

    [[nodiscard]] bool is_split() const { return mode_ == CompareMode::SideBySide; }

    ModelDrawing model_;
    std::optional<CompareMode> mode_;  ///< none: nothing is compared
    std::optional<Reference> reference_;
    int seen_scenes_ = -1;
    bool hides_model_ = false;
    std::shared_ptr<const DeviationMap> difference_;
    std::string reference_title_, shown_title_;  ///< "Reference: Smooth"
    int version_ = 0;
};

}  // namespace vesselbench
