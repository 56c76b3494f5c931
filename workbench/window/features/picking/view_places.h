#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "gpu/render/pick.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/screen_places.h"

namespace vesselbench {

/// What the view shows in a frame, and what the mouse does there.
struct SeenModel {
    SceneView view;
    Layers layers;
    PixelView screen;                  ///< the view in the window
    const Surface* surface = nullptr;  ///< that is drawn; null: none
    int version = 0;                   ///< counts changes of the drawn model
    bool over = false;                 ///< the cursor is over the view, and no button is held
    bool clicked = false;              ///< the left button was released without a drag
};

/// Places in the view: finds what is under the cursor without waiting for the device, gives the
/// clicked place to the armed parameter, and draws marks and labels.
class ViewPlaces {
public:
    /// \param renderer must outlive it \param wake as Viewport's
    ViewPlaces(Renderer& renderer, std::function<void()> wake);

    /// Once a frame, before the model is drawn. May fill in a parameter of the form, or ask for the
    /// role of an opening.
    void update(PanelContext& context, const SeenModel& seen);

    /// Drops the search and what it found.
    void forget();

    /// Marks, hints and the figures of the opening under the cursor, over the model.
    void draw(PanelContext& context, const PixelView& screen) const;

    /// Patch label of the opening under the cursor.
    [[nodiscard]] std::optional<std::uint32_t> lit_patch() const { return lit_patch_; }

    /// The place that a click would pick for the armed parameter [mm].
    [[nodiscard]] std::optional<Vec3> spot() const {
        return spot_ ? std::optional(spot_->point) : std::nullopt;
    }

    /// True while a search runs.
    [[nodiscard]] bool pending() const { return picker_.pending(); }

    /// True if a click that came just before changed the form, so that a second one is no double
    /// click.
    [[nodiscard]] bool took_click() const;

private:
    /// A place of the view at which is searched.
    struct Question {
        ViewPixel cursor = ViewPixel::Zero();
        ViewCamera camera;
        int version = 0;

        bool operator==(const Question&) const = default;
    };

    struct Answer {
        Question question;
        Picked picked;
    };

    void search(const SeenModel& seen, const Question& now);
    void find_spot(const SeenModel& seen, const ViewPixel& cursor, double reach);
    void light_opening(const PanelContext& context, const SeenModel& seen);
    void take_click(PanelContext& context);
    void draw_offered(const PanelContext& context, const PixelView& screen) const;
    void draw_spot(const PanelContext& context, const PixelView& screen) const;
    void draw_opening(PanelContext& context) const;
    [[nodiscard]] std::optional<Vec3> hit() const;

    Picker picker_;
    std::function<void()> wake_;
    Question asked_;
    std::optional<Answer> answer_;
    std::optional<ViewPixel> clicked_;  ///< a click whose place is searched
    std::vector<NamedPlace> offered_;   ///< for the armed parameter
    std::optional<PickSpot> spot_;      ///< that a click would pick
    std::optional<std::uint32_t> lit_patch_;
    double click_time_ = -1e9;  ///< [s] of ImGui
};

}  // namespace vesselbench
