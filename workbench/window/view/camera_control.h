#pragma once

#include <functional>
#include <optional>

#include "gpu/render/pick.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/features/flight/endoscope.h"
#include "workbench/window/view/kept_camera.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

/// What the camera can frame.
struct ViewContent {
    const Surface* surface = nullptr;  ///< that is drawn; null: none
    std::optional<Bounds> image;       ///< of the planes that are seen without a surface
    double aspect = 1.0;               ///< of the view [-]
};

/// The 3D view's camera: frames a model, follows mouse and keys, and flies through the lumen.
class CameraControl {
public:
    /// \param renderer must outlive it \param wake as Viewport's
    CameraControl(Renderer& renderer, const std::function<void()>& wake)
        : picker_(renderer), kept_(wake) {}

    ~CameraControl() { leave_project(); }

    CameraControl(const CameraControl&) = delete;
    CameraControl& operator=(const CameraControl&) = delete;

    [[nodiscard]] const ViewCamera& camera() const { return camera_; }

    void face(StandardView side);

    void switch_perspective() { camera_.perspective = !camera_.perspective; }

    /// True in the lumen.
    [[nodiscard]] bool is_inside() const { return outside_.has_value(); }

    /// True while a place is searched, or the camera flies.
    [[nodiscard]] bool pending() const {
        return picker_.pending() || is_flying() || kept_.pending();
    }

    /// True while it moves by itself: frames should follow one another.
    [[nodiscard]] bool is_flying() const { return endoscope_.moves() || flight_; }

    /// The case is closed.
    void forget();

    // --- framing

    /// Once a frame: a project that was opened shows its model as it was left.
    /// \return true if another project was opened
    bool follow_project(const Document& document);

    /// Frames the model of a project that is seen for the first time, unless it was left in another
    /// view. \return false if it is seen already
    [[nodiscard]] bool begin(const ViewContent& content);

    /// False while it is not known how the project was left.
    [[nodiscard]] bool has_begun() const { return begun_; }

    void frame(const ViewContent& content);

    /// Frames a model that has outgrown the view, or shrunk in it, unless the user moved the
    /// camera.
    void follow(const ViewContent& content);

    /// Zooms out to places beyond the view, unless the user moved the camera. \param places [mm]
    void reach(const Positions& places, const ViewContent& content);

    // --- mouse and keys, while the view's area is ImGui's last item

    /// \param left_is_free a drag with the left button belongs to the camera
    void handle_drag(const PixelView& view, const ViewPixel& mouse, bool left_is_free);

    /// \param plane of the section, which the wheel moves with Ctrl
    void handle_wheel(const PixelView& view, const ViewPixel& mouse, ClipChoice& plane);

    /// \param over the mouse is over the view
    void handle_keys(const PanelContext& context, const ViewContent& content, bool over);

    /// Flies to the place that is to be looked at, and turns to its outside. Once a frame; what the
    /// user does to the camera ends it.
    void take_look(const Workplace& place, const ViewContent& content);

    /// The place under the mouse becomes the centre of turns as soon as it is found, unless the
    /// view is moved before.
    void request_centre(const SceneView& view, const Layers& layers, const Eigen::Vector2i& pixel);

    /// Once a frame: takes the centre that was asked for, if it is found by now.
    /// \return true if the background was found instead
    [[nodiscard]] bool take_centre();

    // --- the lumen

    /// Goes into the lumen, flies, and comes back to where it was before. Once a frame.
    void fly(const PanelContext& context);

    void draw_strip(PanelContext& context, ViewStrips& strips) {
        endoscope_.draw_strip(context, strips);
    }

private:
    void leave_project();
    void handle_view_keys(const KeyCommands& keys, const ViewContent& content);
    void continue_flight(double seconds);

    /// From one camera to another.
    struct Flight {
        ViewCamera from, to, last;  ///< last: as it was set; another one is the user's
        double done = 0.0;          ///< share of the time [-]
    };

    ViewCamera camera_;
    int seen_looks_ = 0, seen_frames_ = 0;
    std::optional<Flight> flight_;  ///< to a place that is looked at
    Endoscope endoscope_;
    Picker picker_;                       ///< for the centre
    std::optional<ViewCamera> centring_;  ///< the camera whose centre is searched
    std::optional<ViewCamera> outside_;   ///< the camera before a flight through the lumen
    KeptCamera kept_;
    int seen_opened_ = 0;                      ///< Document::opened()
    bool has_project_ = false;                 ///< that has not been left
    bool begun_ = false;                       ///< the camera was set for the project's model
    std::optional<ViewCamera> framed_camera_;  ///< as it was set; another one is the user's
};

}  // namespace vesselbench
