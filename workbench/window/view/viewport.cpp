#include "workbench/window/view/viewport.h"

#include <exception>
#include <optional>
#include <utility>

#include <imgui.h>

#include "gpu/render/renderer.h"
#include "workbench/window/core/layout.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/drawing_guard.h"
#include "workbench/window/drawing/view_overlays.h"
#include "workbench/window/drawing/view_strips.h"
#include "workbench/window/features/borders/borders.h"
#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/features/brush/brush_pointer.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/gallery/spot_picker.h"
#include "workbench/window/features/handles/view_handles.h"
#include "workbench/window/features/live/drive_control.h"
#include "workbench/window/features/measures/measure_drawing.h"
#include "workbench/window/features/measures/measuring_tool.h"
#include "workbench/window/features/openings/end_markers.h"
#include "workbench/window/features/openings/role_card.h"
#include "workbench/window/features/picking/view_places.h"
#include "workbench/window/features/picture/view_picture.h"
#include "workbench/window/features/review/review_clicks.h"
#include "workbench/window/features/review/review_marks.h"
#include "workbench/window/features/slices/slice_row.h"
#include "workbench/window/view/camera_control.h"
#include "workbench/window/view/edit_marks.h"
#include "workbench/window/view/view_scene.h"
#include "workbench/window/view/view_tools.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

/// What the mouse does in the view in this frame.
struct ViewMouse {
    bool over = false;        ///< the view, and no control in it
    bool over_model = false;  ///< the part of it that shows the model
    bool released = false;    ///< the left button, after a press in the view
};

/// A double click on ImGui's last item, at its end: its press may be for a control over the item.
bool double_clicked() {
    return ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
           ImGui::GetIO().MouseClickedLastCount[ImGuiMouseButton_Left] == 2;
}

}  // namespace

struct Viewport::Impl {
    explicit Impl(const std::function<void()>& wake)
        : ask_for_frame(wake),
          scene(wake, guard),
          camera(renderer, wake),
          brush(renderer),
          places(renderer, wake),
          spots(renderer, wake),
          handles(wake),
          measuring(renderer, wake),
          reviewing(renderer, wake),
          picture(wake) {}

    void rest(PanelContext& c);
    void draw(PanelContext& c, const ScreenRect& area);
    [[nodiscard]] ViewMouse take_mouse(PanelContext& c, const ScreenRect& area) const;
    void follow_scene(PanelContext& c, const ScreenRect& area);
    void frame_change(PanelContext& c, ViewScene::Change change);

    [[nodiscard]] bool mouse_works() const { return mouse_over || ImGui::IsAnyMouseDown(); }

    void handle_input(PanelContext& c, const ViewMouse& mouse);
    void handle_brush(PanelContext& c);
    void handle_mouse(PanelContext& c);
    [[nodiscard]] bool handle_gallery(PanelContext& c);
    void choose(PanelContext& c);
    void pick_places(PanelContext& c, const ViewMouse& mouse);
    void draw_overlays(PanelContext& c, bool over_view);
    void draw_model_marks(PanelContext& c, const PixelView& screen, bool over_view);
    void draw_controls(PanelContext& c, const ScreenRect& area);
    void draw_frame(PanelContext& c, const ScreenRect& area);
    [[nodiscard]] bool save_picture(PanelContext& c, const ScreenRect& area);

    void look() { scene.look_from(camera.camera(), camera.is_inside()); }

    /// The view's part that shows the model.
    [[nodiscard]] PixelView screen() const { return on_screen(camera.camera(), scene.rect()); }

    [[nodiscard]] ViewContent content() const {
        return {scene.surface(), scene.image_box(), screen().aspect()};
    }

    /// Where the mouse is in the shown model's part, also while it is over the reference.
    [[nodiscard]] ViewPixel mouse_on_model() const {
        const ViewPixel mouse = mouse_pixel();
        return {mouse.x() + scene.shift_at(static_cast<float>(mouse.x())), mouse.y()};
    }

    std::function<void()> ask_for_frame;  ///< soon
    DrawingGuard guard;
    Renderer renderer;
    ViewScene scene;
    CameraControl camera;
    BrushPointer brush;
    ViewPlaces places;
    SpotPicker spots;
    ViewHandles handles;
    EndMarkers ends;
    DriveControl drive;
    MeasuringTool measuring;
    ReviewClicks reviewing;
    ClippedCount clipped;
    ViewPicture picture;
    SliceRow slice_row;
    bool pressed_spot = false;                 ///< the mouse was pressed in a magnified spot
    bool mouse_over = false;                   ///< the view, in the last frame
    bool new_model = false, new_room = false;  ///< that the camera has not followed yet
};

Viewport::Viewport(std::function<void()> wake) : impl_(std::make_unique<Impl>(wake)) {}

Viewport::~Viewport() = default;

bool Viewport::pending() const {
    const Impl& view = *impl_;
    return view.scene.pending() || view.camera.pending() || view.brush.pending() ||
           view.places.pending() || view.spots.pending() || view.handles.pending() ||
           view.measuring.pending() || view.reviewing.pending() || view.picture.pending();
}

const ViewCamera& Viewport::camera() const {
    return impl_->camera.camera();
}

Renderer& Viewport::renderer() {
    return impl_->renderer;
}

int Viewport::drawings() const {
    return impl_->scene.drawings();
}

/// Each part is either destroyed with its case, or would stay pending without it.
void Viewport::Impl::rest(PanelContext& c) {
    scene.forget(c);
    camera.forget();
    brush.forget();
    places.forget();
    spots.forget();
    handles.forget();
    ends.forget();
    drive.forget();
    measuring.forget();
    reviewing.forget();
    slice_row = {};
    clipped = {};
    picture.collect(c.place.document);
}

// --- input

ViewMouse Viewport::Impl::take_mouse(PanelContext& c, const ScreenRect& area) const {
    ImGui::InvisibleButton("view.area", {area.width, area.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemAllowOverlap();
    c.ui.item("view.area");
    const bool over = ImGui::IsItemHovered();
    const bool reference = scene.shift_at(ImGui::GetIO().MousePos.x) != 0;
    const bool beside = reference || scene.gallery().cell_at_mouse();
    return {
        .over = over,
        .over_model = over && !scene.hides_model() && !beside,
        .released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left)};
}

void Viewport::Impl::follow_scene(PanelContext& c, const ScreenRect& area) {
    if (camera.take_centre()) switch_enlarged(c.shown, Enlarged::Model);
    if (camera.follow_project(c.place.document)) new_model = new_room = false;
    camera.take_look(c.place, content());
    const ViewScene::Change change = scene.update(c, area);
    frame_change(c, change);
    look();
}

/// Never under the mouse while it works on the view, nor for what is only tried out: the camera
/// follows when the mouse has left the view, and the form is closed.
void Viewport::Impl::frame_change(PanelContext& c, ViewScene::Change change) {
    new_model |= change == ViewScene::Change::Model;
    new_room |= change == ViewScene::Change::Room;
    if (new_model && camera.begin(content())) {
        new_model = new_room = false;
        return;
    }
    if (!camera.has_begun() || mouse_works() || c.place.document.is_painting()) return;
    const bool follows = std::exchange(new_room, false) || (new_model && !c.place.form());
    if (!follows) return;
    new_model = new_model && c.place.form().has_value();
    camera.follow(content());
}

void Viewport::Impl::handle_input(PanelContext& c, const ViewMouse& mouse) {
    guard.run([&] { handle_brush(c); });
    if (scene.has_content()) {
        handles.update(c, screen());
        drive.update(c, mouse.over_model);
        handle_mouse(c);
    }
    camera.handle_keys(c, content(), mouse.over);
}

void Viewport::Impl::handle_brush(PanelContext& c) {
    if (scene.surface() == nullptr || !scene.is_drawn() || scene.hides_model())
        return brush.rest(c);
    const SceneView view = scene.scene_view(c.ui);
    const Layers shown = scene.layers(c.ui);
    brush.update(c, {view, shown, *scene.surface(), screen()});
}

/// A double click takes a suggestion, and the wheel magnifies a spot.
/// \return true if the mouse is not for the camera
bool Viewport::Impl::handle_gallery(PanelContext& c) {
    GalleryView& gallery = scene.gallery();
    const auto cell = gallery.cell_at_mouse();
    if (ImGui::IsItemActivated()) pressed_spot = gallery.magnifies() && cell;
    if (!ImGui::IsItemActive()) pressed_spot = false;
    const bool over = cell && ImGui::IsItemHovered();
    if (over && gallery.magnifies()) gallery.zoom(ImGui::GetIO().MouseWheel);
    const bool taken =
        over && !c.place.has_click_tool() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (taken) c.place.get<GalleryFeature>().take(*cell);
    return pressed_spot || taken || (over && gallery.magnifies() && !ImGui::IsItemActive());
}

void Viewport::Impl::handle_mouse(PanelContext& c) {
    if (handle_gallery(c)) return;
    camera.handle_drag(screen(), mouse_on_model(), !brush.holds_left() && !handles.holds_left());
    if (!ImGui::IsItemHovered()) return;
    camera.handle_wheel(screen(), mouse_on_model(), c.place.view.clip);
    const bool busy = c.place.get<BrushFeature>().can_paint() ||
                      c.place.view.tool != ClickTool::None || camera.is_inside() ||
                      places.took_click() || handles.has_cursor() || ends.has_cursor();
    if (busy || !scene.is_drawn() || !double_clicked()) return;
    look();
    camera.request_centre(scene.scene_view(c.ui), scene.layers(c.ui),
                          screen().device_pixel(mouse_on_model()));
}

/// What is chosen to be seen, before it is drawn.
void Viewport::Impl::choose(PanelContext& c) {
    if (!mouse_works()) camera.reach(handles.beyond(screen()), content());
    camera.fly(c);
    look();
    scene.choose(
        c, {.lines = handles.lines(), .spot = places.spot(), .lit_patch = places.lit_patch()});
}

void Viewport::Impl::pick_places(PanelContext& c, const ViewMouse& mouse) {
    if (!scene.is_drawn()) return;
    const ImGuiIO& io = ImGui::GetIO();
    const float reach = kClickReach * c.ui.em;
    const bool still = io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < reach * reach;
    const bool over = mouse.over_model && !handles.has_cursor();
    const bool clicked = over && mouse.released && still && !io.KeyShift;
    const bool marked = ends.update(c, screen(), over, clicked);
    const bool free = over && !ends.has_cursor() && !ImGui::IsAnyMouseDown();
    const SeenModel seen{.view = scene.scene_view(c.ui),
                         .layers = scene.layers(c.ui),
                         .screen = screen(),
                         .surface = scene.surface(),
                         .version = scene.version(),
                         .over = free,
                         .clicked = clicked && !marked};
    places.update(c, seen);
    spots.update(c, seen);
    measuring.update(c, seen);
    reviewing.update(c, seen);
}

// --- drawing

void Viewport::Impl::draw_controls(PanelContext& c, const ScreenRect& area) {
    const ToolRequests asked = draw_view_tools(c, area, camera.camera().perspective);
    if (asked.frame) camera.frame(content());
    if (asked.switch_perspective) camera.switch_perspective();
    if (scene.surface() == nullptr) {
        draw_empty_view(c, scene);
        ViewStrips below(scene.rect());
        return measuring.draw_strip(c, below);
    }
    ViewStrips strips(scene.gallery().hides_model() ? scene.gallery().above_plates(area)
                                                    : scene.rect());
    scene.clip().draw_strip(c, strips);
    camera.draw_strip(c, strips);
    measuring.draw_strip(c, strips);
    reviewing.draw_strip(c, strips);
}

void Viewport::Impl::draw_model_marks(PanelContext& c, const PixelView& screen, bool over_view) {
    draw_measures(c, screen);
    draw_review_marks(c, screen);
    draw_edit_marks(c, screen, over_view && !c.place.form() && !c.place.has_click_tool());
}

void Viewport::Impl::draw_overlays(PanelContext& c, bool over_view) {
    if (scene.gallery().hides_model()) return;
    const PixelView view = screen();
    if (scene.surface() != nullptr) scene.overlays().draw_marks(c, view);
    if (scene.has_content()) {
        places.draw(c, view);
        ends.draw(c, view);
        handles.draw(c, view);
        spots.draw(c, view);
        if (!c.place.gallery().picks()) drive.draw(c, scene.rect(), over_view);
    }
    if (scene.surface() != nullptr) draw_model_marks(c, view, over_view);
}

/// Over all of it: what the view is and how large.
void Viewport::Impl::draw_frame(PanelContext& c, const ScreenRect& area) {
    if (!scene.has_content()) return;
    if (scene.surface() != nullptr) {
        brush.draw(c, screen());
        draw_role_card(c, screen());
        ends.draw_card(c, screen());
    }
    scene.gallery().draw_plates(c);
    const ScreenRect rect = scene.gallery().above_plates(scene.rect());
    if (!camera.is_inside()) draw_scale_bar(c.ui, rect, camera.camera());
    const ScreenRect legend = draw_legend(c, scene, clipped), axes = orientation_rect(c.ui, rect);
    const bool free = !axes.overlaps(tool_grid(c.ui, area).rect) && !axes.overlaps(legend) &&
                      axes.y > c.shown.banners_end;
    if (free)
        if (const auto side = draw_orientation(c.ui, rect, camera.camera())) camera.face(*side);
    scene.compared().draw_labels(c.ui, area);
}

/// \return true if this frame is the picture
bool Viewport::Impl::save_picture(PanelContext& c, const ScreenRect& area) {
    const auto alone = [&](int factor, const std::optional<Colour>& background) {
        return scene.picture(renderer, c.ui, factor, background);
    };
    try {
        return picture.update(c, area,
                              scene.shows_model_alone() ? ViewPicture::Draw(alone) : nullptr);
    } catch (const std::exception& error) {
        c.place.document.tell(make_message(
            MessageKind::Error, std::string("the picture cannot be drawn: ") + error.what()));
        return false;
    }
}

void Viewport::Impl::draw(PanelContext& c, const ScreenRect& area) {
    begin_frame(c.ui, "view", area,
                {.back = c.ui.theme.view_below, .padding = 0, .scrolls = false});
    follow_scene(c, area);
    const ViewMouse mouse = take_mouse(c, area);
    mouse_over = mouse.over;
    handle_input(c, mouse);
    choose(c);
    guard.run([&] { pick_places(c, mouse); });
    if (const unsigned texture = scene.draw(renderer, c.ui); texture != 0)
        draw_texture(texture, area);
    const bool saved = save_picture(c, area);
    draw_overlays(c, mouse.over);
    if (!saved) draw_controls(c, area);
    draw_frame(c, area);
    guard.report(c.place.document);
    end_frame();
    if (camera.is_flying() && ask_for_frame) ask_for_frame();
}

namespace {

/// The parts of a view with slices; none: the model takes all of it.
std::optional<ViewParts> parts_of(const PanelContext& c, const ScreenRect& whole) {
    // The gallery needs the height.
    const bool sliced = c.place.slices().in_row() && c.place.gallery().mode() == GalleryMode::Off;
    if (!sliced || c.shown.enlarged == Enlarged::Model) return std::nullopt;
    return view_parts(whole, c.ui.em, c.core.settings.panels, c.shown.enlarged);
}

}  // namespace

ScreenRect Viewport::model_part(const PanelContext& c, const ScreenRect& whole) {
    const auto parts = parts_of(c, whole);
    return parts ? parts->model : whole;
}

void Viewport::draw(PanelContext& c, const ScreenRect& whole) {
    const auto parts = parts_of(c, whole);
    impl_->draw(c, parts ? parts->model : whole);
    if (!parts) return;
    impl_->slice_row.draw(c, {impl_->renderer, impl_->scene.planes(), impl_->guard}, *parts);
    if (parts->border) draw_border(c, *parts->border);
}

void Viewport::rest(PanelContext& c) {
    impl_->rest(c);
}

}  // namespace vesselbench
