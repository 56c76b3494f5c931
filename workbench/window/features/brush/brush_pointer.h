#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "gpu/render/pick.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/features/brush/brush_form.h"

namespace vesselbench {

/// The mouse as a brush in the 3D view: finds the place under the cursor, which arrives a frame or
/// two later, makes strokes of drags, and shows the brush as a circle on the surface.
class BrushPointer {
public:
    /// What the view shows in a frame.
    struct Seen {
        const SceneView& view;
        const Layers& layers;
        const Surface& surface;  ///< the layers' one
        PixelView screen;
    };

    /// The renderer must outlive it.
    explicit BrushPointer(Renderer& renderer) : picker_(renderer) {}

    /// Once a frame, while the view's area is ImGui's last item.
    void update(PanelContext& c, const Seen& seen);

    /// In place of update() while the model is not seen: a stroke still ends with its button.
    void rest(PanelContext& c);

    /// Drops the stroke and the search: the case is closed.
    void forget();

    /// True if drags with the left button do not belong to the camera.
    [[nodiscard]] bool holds_left() const;

    /// True while the place under the cursor is searched.
    [[nodiscard]] bool pending() const { return picker_.pending() || released_; }

    /// The circle, and what the brush does.
    void draw(const PanelContext& c, const PixelView& screen) const;

private:
    using Pixel = ViewPixel;

    /// What the place under the cursor depends on.
    struct Question {
        Pixel pixel;
        ViewCamera camera;
        std::shared_ptr<const Positions> positions;

        bool operator==(const Question&) const = default;
    };

    /// The button goes down while the end of the stroke before is still searched.
    struct Press {
        Pixel at = Pixel::Zero();
        StrokeKeys keys;
        std::optional<Pixel> released_at;  ///< none: it is still down
    };

    void leave(PanelContext& c);
    void begin(const PanelContext& c, const Press& press);
    void end_stroke(PanelContext& c);
    void take_answer(PanelContext& c, const Surface& surface);
    void ask(PanelContext& c, const Seen& seen, bool over);
    void handle_keys(PanelContext& c, bool over);
    void handle_sizing(PanelContext& c);
    void handle_press(PanelContext& c);
    void handle_release(PanelContext& c);
    void extend(PanelContext& c);
    [[nodiscard]] Pixel wanted_pixel() const;

    Picker picker_;
    Stroke stroke_;
    StrokeKeys keys_;
    std::optional<Question> asked_;
    std::optional<StrokePlace> place_;  ///< the last answer
    std::optional<Pixel> extended_;     ///< to where the stroke goes
    Pixel pressed_at_ = Pixel::Zero(), released_at_ = Pixel::Zero();
    bool released_ = false;          ///< the stroke ends at released_at_
    std::deque<Press> waiting_;      ///< strokes to come
    std::optional<BrushTip> sized_;  ///< the tip when sizing began
    double sized_from_ = 0;          ///< [pixels]
    bool shown_ = false;
};

}  // namespace vesselbench
