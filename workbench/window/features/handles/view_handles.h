#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "geometry/kernel/measure.h"
#include "geometry/vessel/openings/planned_cut.h"
#include "workbench/session/task.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/handles/deform_handles.h"
#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// The form's handles in the view: finds the one under the cursor, fills in the form's texts while
/// one is dragged, and draws them. What they do is decided in the model's rooms.
class ViewHandles {
public:
    /// \param wake as Viewport's
    explicit ViewHandles(const std::function<void()>& wake) : search_(wake), deform_(wake) {}

    /// Once a frame, while the view's area is ImGui's last item, before the camera follows the
    /// mouse.
    void update(PanelContext& context, const PixelView& screen);

    /// Drops a drag and the search: the case is closed.
    void forget();

    /// True if a drag with the left button does not belong to the camera.
    [[nodiscard]] bool holds_left() const { return state_ != State::Idle; }

    /// True while the cursor is over a handle, or drags one.
    [[nodiscard]] bool has_cursor() const { return hot_.has_value() || holds_left(); }

    /// True while a cut or a bent branch is searched.
    [[nodiscard]] bool pending() const { return search_.pending() || deform_.pending(); }

    [[nodiscard]] const std::vector<RegionLine>& lines() const { return shape_.lines; }

    /// The handles' places, if one of them is outside the view; else empty [mm].
    [[nodiscard]] Positions beyond(const PixelView& screen) const;

    /// Marks and notes, over the model.
    void draw(PanelContext& context, const PixelView& screen) const;

private:
    enum class State {
        Idle,
        Dragging,
        Dropped  ///< cancelled, but the button is still down
    };

    /// What a drag refers to: all of it as it was when the drag began.
    struct Start {
        std::size_t index = 0;
        Handle handle;
        std::optional<Cut> cut;
        std::optional<OperationForm> cut_form;
        std::optional<BranchPreview> branch;
        std::vector<PatchMeasures> openings;
        ViewPixel cursor = ViewPixel::Zero();
        ViewPixel offset = ViewPixel::Zero();  ///< from the handle to the cursor
    };

    void take_model(const PanelContext& context);
    void take_shape(const PanelContext& context);
    void take_cut(const Surface* surface, const std::optional<CutQuestion>& question);
    void find_hot(const PanelContext& context, const PixelView& view, const ViewPixel& cursor);
    void begin(PanelContext& context, const PixelView& view, const ViewPixel& cursor);
    void follow(PanelContext& context, const PixelView& view, const ViewPixel& cursor);
    [[nodiscard]] std::vector<FieldText> texts(const PanelContext& context, const Vec3& to,
                                               double snap) const;
    void draw_handle(PanelContext& context, const PixelView& screen, std::size_t index) const;

    Task<Cut> search_;
    std::optional<CutQuestion> asked_;  ///< none: there is nothing to cut
    Surface asked_surface_;
    std::optional<Cut> cut_;  ///< the last one of the question's branch; none: not known yet
    std::optional<OperationForm> cut_form_;  ///< of the one cut that has handles
    DeformSearch deform_;
    FormShape shape_;
    std::vector<PatchMeasures> openings_;  ///< of the model, without a preview
    State state_ = State::Idle;
    std::optional<std::size_t> hot_;
    Start start_;
};

}  // namespace vesselbench
