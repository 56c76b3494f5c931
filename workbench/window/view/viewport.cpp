#include "workbench/window/view/viewport.h"

#include <array>
#include <cmath>
#include <optional>

#include <imgui.h>

#include "gpu/render/pick.h"
#include "gpu/render/renderer.h"
#include "gpu/render/target.h"
#include "workbench/window/keys.h"
#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/view/branch_highlight.h"
#include "workbench/window/view/brush_pointer.h"
#include "workbench/window/view/comparison_view.h"
#include "workbench/window/view/edit_marks.h"
#include "workbench/window/view/model_drawing.h"
#include "workbench/window/view/region_drawing.h"
#include "workbench/window/view/role_card.h"
#include "workbench/window/view/slice_planes.h"
#include "workbench/window/view/slice_row.h"
#include "workbench/window/view/view_handles.h"
#include "workbench/window/view/view_overlays.h"
#include "workbench/window/view/view_places.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

constexpr double kTurnPerHeight = 3.5;  ///< a drag over the view's height turns by this [rad]
constexpr double kZoomPerNotch = 1.15;  ///< of the wheel
constexpr double kMargin = 0.12;        ///< around a framed model [-]
constexpr double kSlack = 0.1;  ///< a framed model may change by this before the view follows [-]
constexpr double kLinePull = 0.01;   ///< of lines on the surface, by half the view's height [-]
constexpr float kClickReach = 0.3F;  ///< the mouse may move so far in a click [em]

/// From the front, somewhat from the left and above: all three planes of an image are seen.
const ViewCamera kObliqueView = {.view = {-0.45, 0.75, -0.4}, .up = {0, 0, 1}};

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

    bool operator==(const DrawnAs&) const = default;
};

}  // namespace

struct Viewport::Impl {
    explicit Impl(const std::function<void()>& wake)
        : model(wake),
          compared(wake),
          picker(renderer),
          brush(renderer),
          places(renderer, wake),
          handles(wake),
          branch(wake) {}

    void take_scene(PanelContext& c);
    void take_comparison(PanelContext& c);
    void take_form(PanelContext& c);
    void take_slices(PanelContext& c);
    void pick_places(PanelContext& c, bool over, bool released);
    void frame_model();
    void follow_model();
    void follow_handles();
    void draw_model(const Ui& ui);
    void handle_brush(PanelContext& c);
    void handle_mouse(bool sets_centre);
    void handle_keys(bool over_view);
    void set_centre();
    void draw_toolbar(PanelContext& c);
    void draw_toggle(PanelContext& c, const std::string& name, const char* icon,
                     const std::string& help, bool& on);
    void draw_overlays(PanelContext& c, bool over_view);
    void draw_empty(PanelContext& c) const;
    [[nodiscard]] SceneView scene_view(const Ui& ui) const;
    [[nodiscard]] ViewLook model_look() const;
    [[nodiscard]] Layers layers(const Ui& ui) const;
    [[nodiscard]] Eigen::Vector2d mouse_ndc() const;

    [[nodiscard]] double aspect() const { return rect.height > 0 ? rect.width / rect.height : 1; }

    /// Whether there is anything to look at.
    [[nodiscard]] bool has_content() const {
        return model.surface() != nullptr || planes.any_in_space();
    }

    ModelDrawing model;
    ComparisonView compared;
    Renderer renderer;
    Picker picker;
    BrushPointer brush;
    ViewPlaces places;
    ViewHandles handles;
    BranchHighlight branch;
    RegionDrawing region;
    SlicePlanes planes;
    SliceRow slice_row;
    std::optional<Bounds> image_box;  ///< of the slices that are shown
    std::optional<RenderTarget> target;
    unsigned texture = 0;
    ViewCamera camera;
    ViewLook look;
    ScreenRect area;  ///< all of the view
    ScreenRect rect;  ///< the part of it that shows the model
    std::optional<DrawnAs> drawn;
    std::filesystem::path framed_project;     ///< whose model the camera was set for
    std::optional<ViewCamera> framed_camera;  ///< as it was set; another one is the user's
    int seen_scenes = -1;
    float seen_width = 0;  ///< of the area
    int models = 0;        ///< counts changes of the drawn model
    int drawings = 0;
    bool dark = true;
};

Viewport::Viewport(std::function<void()> wake) : impl_(std::make_unique<Impl>(wake)) {}

Viewport::~Viewport() = default;

bool Viewport::pending() const {
    return impl_->model.pending() || impl_->compared.pending() || impl_->brush.pending() ||
           impl_->places.pending() || impl_->handles.pending() || impl_->branch.pending();
}

const ViewCamera& Viewport::camera() const {
    return impl_->camera;
}

Renderer& Viewport::renderer() {
    return impl_->renderer;
}

int Viewport::drawings() const {
    return impl_->drawings;
}

void Viewport::Impl::take_scene(PanelContext& c) {
    Document& document = c.place.document;
    if (seen_scenes != document.scene_changes()) {
        seen_scenes = document.scene_changes();
        static_cast<void>(document.take_moves());
        model.show(document.shown());
        drawn.reset();
    }
    for (const SceneMove& move : document.take_moves()) model.move(move);
    const auto& form = c.place.form();
    model.set_painted(form ? painted_attribute(*form) : "");
    document.want_deviation(look.deviation);
    model.set_deviation(compared.colours_model() ? compared.difference() : document.deviation());
    if (!model.update()) return;
    drawn.reset();
    ++models;
    if (framed_project != document.project() && model.surface() != nullptr) {
        framed_project = document.project();
        camera = facing(camera, StandardView::Anterior);
        frame_model();
    } else {
        follow_model();
    }
}

/// What is compared, and the room that it leaves to the model.
void Viewport::Impl::take_comparison(PanelContext& c) {
    compared.update(c);
    const float before = rect.width;
    const bool resized = area.width != seen_width;
    seen_width = area.width;
    rect = compared.room_for_model(area);
    if (before != rect.width && !resized) follow_model();
}

ViewLook Viewport::Impl::model_look() const {
    ViewLook own = look;
    own.deviation = look.deviation || compared.colours_model();
    return own;
}

/// An image without a surface is looked at as a whole.
void Viewport::Impl::take_slices(PanelContext& c) {
    planes.update(c.place.slices());
    const SliceGrid& grid = c.place.slices().grid();
    image_box.reset();
    if (planes.any_in_space()) image_box = Bounds{grid.low, grid.high()};
    if (model.surface() != nullptr || model.pending() || !planes.any_in_space() ||
        framed_project == c.place.document.project())
        return;
    framed_project = c.place.document.project();
    camera = kObliqueView;
    frame_model();
}

/// What the form describes.
void Viewport::Impl::take_form(PanelContext& c) {
    const auto& form = c.place.form();
    region.show(form && has_content() ? handles.lines() : std::vector<RegionLine>());
    const bool previews = c.place.document.previewed().has_value();
    branch.update(form && !previews ? &*form : nullptr, model.surface(), places.spot());
}

/// \param over the cursor is over the view \param released the left button was, after a press in
/// the view
void Viewport::Impl::pick_places(PanelContext& c, bool over, bool released) {
    if (!target) return;
    const ImGuiIO& io = ImGui::GetIO();
    const float reach = kClickReach * c.ui.em;
    const bool still = io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < reach * reach;
    places.update(c,
                  {.view = scene_view(c.ui),
                   .layers = layers(c.ui),
                   .rect = rect,
                   .surface = model.surface(),
                   .version = models,
                   .over = over && !ImGui::IsAnyMouseDown() && !handles.has_cursor(),
                   .clicked = over && released && still && !io.KeyShift && !handles.has_cursor()});
}

void Viewport::Impl::frame_model() {
    if (model.surface() != nullptr)
        camera = framed(camera, model.surface()->points(), aspect(), kMargin);
    else if (image_box)
        camera = framed(camera, *image_box, aspect(), kMargin);
    framed_camera = camera;
}

/// Frames a model that has outgrown the view, or shrunk in it, unless the user moved the camera.
void Viewport::Impl::follow_model() {
    if (model.surface() == nullptr || framed_camera != camera) return;
    const ViewCamera fitting = framed(camera, model.surface()->points(), aspect(), kMargin);
    const double growth = fitting.half_height / camera.half_height;
    const double shift = (fitting.centre - camera.centre).norm() / camera.half_height;
    if (growth > 1.0 + kSlack || growth < 1.0 - 3.0 * kSlack || shift > kSlack) frame_model();
}

/// Zooms out to handles that are beyond the view, as follow_model.
void Viewport::Impl::follow_handles() {
    if (model.surface() == nullptr || framed_camera != camera || handles.holds_left()) return;
    Positions points = handles.beyond({camera, rect});
    if (points.empty()) return;
    const Positions& shown = model.surface()->points();
    points.insert(points.end(), shown.begin(), shown.end());
    camera = framed(camera, points, aspect(), kMargin);
    framed_camera = camera;
}

Layers Viewport::Impl::layers(const Ui& ui) const {
    const double line = std::max(1.0, ui.em / 15.0);
    Layers layers = model.layers(model_look(), line);
    for (SurfaceLayer& layer : layers.surfaces) layer.highlighted_patch = places.lit_patch();
    planes.add_to(layers, line);
    const double pull = kLinePull * camera.half_height;
    branch.add_to(layers, pull / 2);
    region.add_to(layers, 2 * line, pull);
    return layers;
}

SceneView Viewport::Impl::scene_view(const Ui& ui) const {
    return {.camera = camera,
            .rectangle = {0, 0, std::max(1, static_cast<int>(rect.width)),
                          std::max(1, static_cast<int>(rect.height))},
            .background = Background{linear(ui.theme.view_above), linear(ui.theme.view_below)}};
}

void Viewport::Impl::draw_model(const Ui& ui) {
    const int width = std::max(1, static_cast<int>(area.width));
    const int height = std::max(1, static_cast<int>(area.height));
    const DrawnAs now{camera,
                      look,
                      width,
                      height,
                      ui.theme.dark,
                      places.lit_patch(),
                      region.version(),
                      branch.version(),
                      planes.space_version(),
                      compared.version()};
    if (drawn == now) return;
    if (!target) target.emplace(width, height);
    target->resize(width, height);
    target->bind();
    SceneView view = scene_view(ui);
    view.rectangle.x = static_cast<int>(rect.x - area.x);
    if (!compared.hides_model()) renderer.draw(view, layers(ui));
    compared.draw(renderer, view, look, std::max(1.0, ui.em / 15.0));
    texture = target->resolve();
    drawn = now;
    ++drawings;
}

Eigen::Vector2d Viewport::Impl::mouse_ndc() const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float x = mouse.x + compared.shift_to_model(area, mouse.x);
    return {2.0 * (x - rect.x) / rect.width - 1.0, 1.0 - 2.0 * (mouse.y - rect.y) / rect.height};
}

void Viewport::Impl::handle_brush(PanelContext& c) {
    if (!target || compared.hides_model()) return;
    const SceneView view = scene_view(c.ui);
    const Layers shown = layers(c.ui);
    brush.update(c, {view, shown, *model.surface(), rect});
}

void Viewport::Impl::handle_mouse(bool sets_centre) {
    const ImGuiIO& io = ImGui::GetIO();
    const Eigen::Vector2d now = mouse_ndc();
    const Eigen::Vector2d moved(2.0 * io.MouseDelta.x / rect.width,
                                -2.0 * io.MouseDelta.y / rect.height);
    const bool middle = ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    if (ImGui::IsItemActive() && moved.norm() > 0 &&
        (middle || !(brush.holds_left() || handles.holds_left()))) {
        const bool pans = middle || io.KeyShift;
        const double turn = kTurnPerHeight / rect.height;
        if (pans)
            camera = panned(camera, aspect(), now - moved, now);
        else
            camera = turned(camera, turn * io.MouseDelta.x, -turn * io.MouseDelta.y);
    }
    if (!ImGui::IsItemHovered()) return;
    if (io.MouseWheel != 0)
        camera = zoomed(camera, aspect(), std::pow(kZoomPerNotch, io.MouseWheel), now);
    if (sets_centre && !places.took_click() && !handles.has_cursor() &&
        ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        set_centre();
}

void Viewport::Impl::set_centre() {
    if (!target) return;
    Ui plain;  // ids do not depend on colours
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Picked picked =
        picker.pick(scene_view(plain), layers(plain),
                    static_cast<int>(mouse.x + compared.shift_to_model(area, mouse.x) - rect.x),
                    static_cast<int>(rect.height - 1 - (mouse.y - rect.y)));
    if (picked.layer != 0) camera.centre = picked.point;
}

void Viewport::Impl::handle_keys(bool over_view) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || !over_view) return;
    const auto pressed = [](int digit) {
        return ImGui::IsKeyPressed(keys::k0 + digit, false) ||
               ImGui::IsKeyPressed(keys::kPad0 + digit, false);
    };
    const bool opposite = io.KeyCtrl;
    using enum StandardView;
    if (pressed(1)) camera = facing(camera, opposite ? Posterior : Anterior);
    if (pressed(3)) camera = facing(camera, opposite ? Right : Left);
    if (pressed(7)) camera = facing(camera, opposite ? Inferior : Superior);
    if (pressed(5)) camera.perspective = !camera.perspective;
    if (ImGui::IsKeyPressed(keys::kHome, false)) frame_model();
}

void Viewport::Impl::draw_toggle(PanelContext& c, const std::string& name, const char* icon,
                                 const std::string& help, bool& on) {
    ImGui::SameLine(0, c.ui.grid(0.25F));
    if (icon_button(c.ui, name, icon, help, true, on)) on = !on;
}

void Viewport::Impl::draw_toolbar(PanelContext& c) {
    const float pad = c.ui.grid(0.5F), side = ImGui::GetFrameHeight();
    const bool has_image = c.place.slices().has_image();
    const auto count = has_image ? 7.0F : 6.0F;
    const float width = count * side + (count - 1) * c.ui.grid(0.25F) + 2 * pad;
    const ImVec2 at{area.x + c.ui.grid(1.5F), area.y + c.ui.grid(1.5F)};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 to{at.x + width, at.y + side + 2 * pad};
    draw.AddRectFilled(at, to, faded(c.ui.theme.panel, 0.9), ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorScreenPos({at.x + pad, at.y + pad});
    if (icon_button(c.ui, "view.fit", icons::kFit, "Show everything  Home")) frame_model();
    draw_toggle(c, "view.edges", icons::kGrid, "Triangles' edges", look.edges);
    draw_toggle(c, "view.flat", icons::kFlat, "Flat shading", look.flat);
    draw_toggle(c, "view.transparent", icons::kTransparent, "Transparent", look.transparent);
    draw_toggle(c, "view.deviation", icons::kPalette,
                "Colours show the distance from the source, or of a preview from before it",
                look.deviation);
    draw_toggle(c, "view.perspective", icons::kPerspective, "Perspective  5", camera.perspective);
    if (!has_image) return;
    bool planes_shown = c.place.slices().any_in_space();
    draw_toggle(c, "view.slices", icons::kImage, "Planes of the image  Shift+I", planes_shown);
    if (planes_shown != c.place.slices().any_in_space())
        c.place.slices().show_in_space(planes_shown);
}

void Viewport::Impl::draw_overlays(PanelContext& c, bool over_view) {
    if (has_content()) {
        places.draw(c, {camera, rect});
        handles.draw(c, {camera, rect});
    }
    if (model.surface() != nullptr) {
        draw_edit_marks(c, {camera, rect}, over_view && !c.place.form());
    }
    draw_toolbar(c);
    if (model.surface() == nullptr) draw_empty(c);
    if (!has_content()) return;
    if (model.surface() != nullptr) {
        brush.draw(c, camera, rect);
        draw_role_card(c, {camera, rect});
    }
    draw_scale_bar(c.ui, rect, camera);
    if (const auto side = draw_orientation(c.ui, rect, camera)) camera = facing(camera, *side);
    compared.draw_labels(c.ui, area);
    ScreenRect legend = rect;
    if (compared.colours_model()) legend.y += c.ui.em * 1.5F;  // below the comparison's banner
    if (model.shows_deviation(model_look()) && !compared.hides_model())
        draw_deviation_legend(c.ui, legend, model.deviation()->full,
                              compared.colours_model()       ? "Distance from the reference [mm]"
                              : c.place.document.previewed() ? "Distance from before [mm]"
                                                             : "Distance from the source [mm]");
}

/// What to do while there is no surface.
void Viewport::Impl::draw_empty(PanelContext& c) const {
    const Scene* scene = c.place.document.shown();
    const bool image = scene != nullptr && scene->image;
    const std::string words = scene == nullptr || model.pending() ? "Reading the model"
                              : image                             ? "The image has no surface yet"
                                                                  : "The case is empty";
    const float width = ImGui::CalcTextSize(words.c_str()).x, wide = c.ui.em * 12;
    const float x = rect.x + rect.width / 2, y = rect.y + rect.height / 2;
    if (has_content()) {  // the image's planes; beside them
        ImGui::SetCursorScreenPos(
            {rect.x + rect.width - wide - c.ui.grid(1.5F), rect.y + c.ui.grid(1.5F)});
    } else {
        ImGui::SetCursorScreenPos({x - width / 2, y - c.ui.em * 2});
        text(c.ui, words, c.ui.theme.text);
        ImGui::SetCursorScreenPos({x - wide / 2, y - c.ui.em * 0.5F});
    }
    if (!image || c.place.form()) return;
    if (button(c.ui, "view.extract", "Extract surface", {.primary = true, .width = wide}))
        c.place.choose("extract-surface");
}

void Viewport::draw(PanelContext& c, const ScreenRect& whole) {
    Impl& view = *impl_;
    const bool sliced = c.place.slices().in_row();
    const ScreenRect row = slice_row_rect(whole);
    const ScreenRect rect{whole.x, whole.y, whole.width,
                          sliced ? row.y - 1 - whole.y : whole.height};
    view.area = rect;
    begin_frame(c.ui, "view", rect,
                {.back = c.ui.theme.view_below, .padding = 0, .scrolls = false});
    view.take_comparison(c);
    view.take_scene(c);
    view.take_slices(c);
    ImGui::InvisibleButton("view.area", {rect.width, rect.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemAllowOverlap();
    c.ui.item("view.area");
    const bool over = ImGui::IsItemHovered();
    const bool over_model = over && !view.compared.hides_model() &&
                            view.compared.shift_to_model(rect, ImGui::GetIO().MousePos.x) == 0;
    const bool released =
        ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    if (view.model.surface() != nullptr) view.handle_brush(c);
    if (view.has_content()) {
        view.handles.update(c, {view.camera, view.rect});
        view.handle_mouse(!c.place.can_paint());
    }
    view.handle_keys(over);
    view.take_form(c);
    view.follow_handles();
    view.pick_places(c, over_model, released);
    view.draw_model(c.ui);
    const ImVec2 to{rect.x + rect.width, rect.y + rect.height};
    ImGui::GetWindowDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(std::uintptr_t{view.texture}), {rect.x, rect.y}, to, {0, 1},
        {1, 0});
    view.draw_overlays(c, over);
    end_frame();
    if (sliced) view.slice_row.draw(c, {view.renderer, view.planes}, row);
}

}  // namespace vesselbench
