#include "workbench/window/view/viewport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <imgui.h>

#include "gpu/render/pick.h"
#include "gpu/render/renderer.h"
#include "gpu/render/target.h"
#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/view/branch_highlight.h"
#include "workbench/window/view/brush_pointer.h"
#include "workbench/window/view/clip_section.h"
#include "workbench/window/view/comparison_view.h"
#include "workbench/window/view/drawing_guard.h"
#include "workbench/window/view/edit_marks.h"
#include "workbench/window/view/endoscope.h"
#include "workbench/window/view/measuring_tool.h"
#include "workbench/window/view/model_drawing.h"
#include "workbench/window/view/overlay_layers.h"
#include "workbench/window/view/region_drawing.h"
#include "workbench/window/view/role_card.h"
#include "workbench/window/view/slice_planes.h"
#include "workbench/window/view/slice_row.h"
#include "workbench/window/view/view_handles.h"
#include "workbench/window/view/view_overlays.h"
#include "workbench/window/view/view_picture.h"
#include "workbench/window/view/view_places.h"
#include "workbench/window/view/view_strips.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

constexpr double kTurnPerHeight = 3.5;   ///< a drag over the view's height turns by this [rad]
constexpr double kZoomPerNotch = 1.15;   ///< of the wheel
constexpr double kClipPerNotch = 0.02;   ///< of the way through the model [-]
constexpr double kFlightPerNotch = 0.5;  ///< [local radii]
constexpr double kLookHeight = 8.0;      ///< around a place that is looked at [mm]
constexpr double kMargin = 0.12;         ///< around a framed model [-]
constexpr double kSlack = 0.1;  ///< a framed model may change by this before the view follows [-]
constexpr double kLinePull = 0.01;   ///< of lines on the surface, by half the view's height [-]
constexpr float kClickReach = 0.3F;  ///< the mouse may move so far in a click [em]

/// From the front, somewhat from the left and above: all three planes of an image are seen.
const ViewCamera kObliqueView = {.view = {-0.45, 0.75, -0.4}, .up = {0, 0, 1}};

constexpr std::array<std::pair<KeyCommand, StandardView>, 6> kSides = {
    {{KeyCommand::Anterior, StandardView::Anterior},
     {KeyCommand::Posterior, StandardView::Posterior},
     {KeyCommand::Left, StandardView::Left},
     {KeyCommand::Right, StandardView::Right},
     {KeyCommand::Superior, StandardView::Superior},
     {KeyCommand::Inferior, StandardView::Inferior}}};

std::optional<ValueRange> range_of(const std::shared_ptr<const DeviationMap>& map) {
    return map ? std::optional(ValueRange{-map->full, map->full}) : std::nullopt;
}

/// The range of what is drawn in colours; none: not known, or there are no colours.
std::optional<ValueRange> automatic_range(const Workplace& place, const ComparisonView& compared) {
    if (compared.colours_model()) return range_of(compared.difference());
    const auto& colours = place.view_data().colours();
    const ColouringKind kind = place.view.colouring;
    if (colours && colours->kind == kind) return colours->range;
    return kind == ColouringKind::Deviation ? range_of(place.document.deviation()) : std::nullopt;
}

bool draw_tool(PanelContext& c, const std::string& name, const char* icon, const std::string& help,
               bool on) {
    ImGui::SameLine(0, c.ui.grid(0.25F));
    return icon_button(c.ui, name, icon, help, true, on);
}

ViewLook look_of(const Workplace& place) {
    return {.edges = place.settings.layers.edges,
            .flat = place.settings.layers.flat,
            .transparent = place.view.transparent,
            .deviation = place.view.colouring == ColouringKind::Deviation};
}

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
    ValueRange range;
    int clip = 0;      ///< version of the clip plane and its section
    int overlays = 0;  ///< version of theirs
    bool inside = false;

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
          branch(wake),
          measuring(renderer, wake),
          clip(wake),
          overlays(wake),
          picture(wake) {}

    void rest(PanelContext& c);
    void take_scene(PanelContext& c);
    void take_comparison(PanelContext& c);
    void take_form(PanelContext& c);
    void take_slices(PanelContext& c);
    void pick_places(PanelContext& c, bool over, bool released);
    void frame_model();
    void follow_model(const Document& document);
    void follow_handles();
    void draw_model(const Ui& ui);
    void draw_picture(const Ui& ui);
    void handle_brush(PanelContext& c);
    void fly(const PanelContext& c);
    void take_choices(PanelContext& c);
    void handle_mouse(PanelContext& c);
    void handle_drag(const Eigen::Vector2d& moved);
    void take_look(const Workplace& place);
    void handle_wheel(PanelContext& c, float notches);
    void handle_keys(const PanelContext& c, bool over_view);
    void request_centre();
    void take_centre();
    void draw_toolbar(PanelContext& c);
    void draw_legend(const PanelContext& c) const;
    void draw_overlays(PanelContext& c, bool over_view);
    void draw_controls(PanelContext& c);
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
    int seen_looks = 0;
    ComparisonView compared;
    Renderer renderer;
    DrawingGuard guard;
    Picker picker;                       ///< for the centre of turns
    std::optional<ViewCamera> centring;  ///< the camera whose centre is searched
    BrushPointer brush;
    ViewPlaces places;
    ViewHandles handles;
    BranchHighlight branch;
    MeasuringTool measuring;
    ClipSection clip;
    OverlayLayers overlays;
    Endoscope endoscope;
    ViewPicture picture;
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
    std::optional<ViewCamera> outside;        ///< the camera before a flight through the lumen
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
    const Impl& view = *impl_;
    return view.model.pending() || view.picker.pending() || view.compared.pending() ||
           view.brush.pending() || view.places.pending() || view.handles.pending() ||
           view.branch.pending() || view.measuring.pending() || view.clip.pending() ||
           view.overlays.pending() || view.endoscope.moves() || view.picture.pending();
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
    look = look_of(c.place);
    document.want_deviation(look.deviation);
    model.set_deviation(compared.colours_model() ? compared.difference() : document.deviation());
    const auto& colours = c.place.view_data().colours();
    const bool on_model =
        colours && !compared.colours_model() && colours->kind != ColouringKind::TetrahedraQuality;
    model.set_colouring(on_model ? colours : nullptr);
    c.place.view.draw_as({c.place.view.colouring, compared.colours_model()},
                         automatic_range(c.place, compared));
    model.set_range(c.place.view.range());
    if (!model.update()) return;
    drawn.reset();
    ++models;
    if (framed_project != document.project() && model.surface() != nullptr) {
        framed_project = document.project();
        camera = facing(camera, StandardView::Anterior);
        frame_model();
    } else if (model.is_new()) {
        follow_model(document);
    }
}

/// Parts that are destroyed with their case, or would stay pending without it.
void Viewport::Impl::rest(PanelContext& c) {
    model.show(nullptr);
    static_cast<void>(model.update());
    compared.forget();
    picker.forget();
    brush.forget();
    places.forget();
    handles.forget();
    branch.update(nullptr, nullptr, {});
    measuring.forget();
    clip.forget();
    overlays.forget();
    endoscope = {};
    region.show({});
    planes.update(c.place.slices());
    slice_row = {};
    picture.collect(c.place.document);
    target.reset();
    texture = 0;
    drawn.reset();
    outside.reset();
    framed_project.clear();
    framed_camera.reset();
    image_box.reset();
    seen_scenes = -1;
}

/// What is compared, and the room that it leaves to the model.
void Viewport::Impl::take_comparison(PanelContext& c) {
    compared.update(c);
    const float before = rect.width;
    const bool resized = area.width != seen_width;
    seen_width = area.width;
    rect = compared.room_for_model(area);
    if (before != rect.width && !resized) follow_model(c.place.document);
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
    const SeenModel seen{
        .view = scene_view(c.ui),
        .layers = layers(c.ui),
        .rect = rect,
        .surface = model.surface(),
        .version = models,
        .over = over && !ImGui::IsAnyMouseDown() && !handles.has_cursor(),
        .clicked = over && released && still && !io.KeyShift && !handles.has_cursor()};
    places.update(c, seen);
    measuring.update(c, seen);
}

/// Puts the camera into the lumen, and back to where it was before.
void Viewport::Impl::fly(const PanelContext& c) {
    endoscope.update(c, ImGui::GetIO().DeltaTime);
    const auto inside = endoscope.camera();
    if (inside && !outside) outside = camera;
    if (inside)
        camera = *inside;
    else if (outside)
        camera = *std::exchange(outside, std::nullopt);
}

/// What is chosen to be seen, before it is drawn.
void Viewport::Impl::take_choices(PanelContext& c) {
    guard.run([&] { take_form(c); });
    follow_handles();
    fly(c);
    guard.run([&] { clip.update(c, model.surface(), camera); });
    guard.run([&] { overlays.update(c); });
    guard.note(model.problem());
    guard.note(compared.problem());
}

void Viewport::Impl::frame_model() {
    outside.reset();
    if (model.surface() != nullptr)
        camera = framed(camera, model.surface()->points(), aspect(), kMargin);
    else if (image_box)
        camera = framed(camera, *image_box, aspect(), kMargin);
    framed_camera = camera;
}

/// Frames a model that has outgrown the view, or shrunk in it, unless the user moved the camera or
/// paints.
void Viewport::Impl::follow_model(const Document& document) {
    if (model.surface() == nullptr || framed_camera != camera || document.is_painting()) return;
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
    for (SurfaceLayer& layer : layers.surfaces) {
        layer.highlighted_patch = places.lit_patch();
        layer.back_as_front = outside.has_value();
    }
    planes.add_to(layers, line);
    clip.add_to(layers, line);
    overlays.add_to(layers, line, ui.theme.dark);
    const double pull = kLinePull * camera.half_height;
    branch.add_to(layers, pull / 2);
    region.add_to(layers, 2 * line, pull);
    return layers;
}

SceneView Viewport::Impl::scene_view(const Ui& ui) const {
    return {.camera = camera,
            .rectangle = {0, 0, std::max(1, static_cast<int>(rect.width)),
                          std::max(1, static_cast<int>(rect.height))},
            .clip = clip.plane(),
            .background = Background{linear(ui.theme.view_above), linear(ui.theme.view_below)}};
}

void Viewport::Impl::draw_model(const Ui& ui) {
    if (guard.run([&] { draw_picture(ui); })) return;
    drawn.reset();
    texture = 0;
}

void Viewport::Impl::draw_picture(const Ui& ui) {
    const int width = std::max(1, static_cast<int>(area.width));
    const int height = std::max(1, static_cast<int>(area.height));
    const DrawnAs now{.camera = camera,
                      .look = look,
                      .width = width,
                      .height = height,
                      .dark = ui.theme.dark,
                      .lit_patch = places.lit_patch(),
                      .region = region.version(),
                      .branch = branch.version(),
                      .slices = planes.space_version(),
                      .compared = compared.version(),
                      .range = model.colour_range(),
                      .clip = clip.version(),
                      .overlays = overlays.version(),
                      .inside = outside.has_value()};
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

/// \param moved by the mouse [ndc]
void Viewport::Impl::handle_drag(const Eigen::Vector2d& moved) {
    const ImGuiIO& io = ImGui::GetIO();
    const double turn = kTurnPerHeight / rect.height;
    const Eigen::Vector2d now = mouse_ndc();
    if (outside)
        endoscope.look_round(-turn * io.MouseDelta.x / 2, turn * io.MouseDelta.y / 2);
    else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || io.KeyShift)
        camera = panned(camera, aspect(), now - moved, now);
    else
        camera = turned(camera, turn * io.MouseDelta.x, -turn * io.MouseDelta.y);
}

/// Turns to the place that a message names.
void Viewport::Impl::take_look(const Workplace& place) {
    if (std::exchange(seen_looks, place.looks()) == place.looks() || !place.looked_at()) return;
    camera.centre = *place.looked_at();
    camera.half_height = std::min(camera.half_height, kLookHeight);
}

void Viewport::Impl::handle_wheel(PanelContext& c, float notches) {
    ClipChoice& plane = c.place.view.clip;
    if (plane.on && ImGui::GetIO().KeyCtrl)
        plane.place = std::clamp(plane.place + kClipPerNotch * notches, 0.0, 1.0);
    else if (outside)
        endoscope.advance(kFlightPerNotch * notches);
    else
        camera = zoomed(camera, aspect(), std::pow(kZoomPerNotch, notches), mouse_ndc());
}

void Viewport::Impl::handle_mouse(PanelContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    const Eigen::Vector2d moved(2.0 * io.MouseDelta.x / rect.width,
                                -2.0 * io.MouseDelta.y / rect.height);
    const bool middle = ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    const bool held = brush.holds_left() || handles.holds_left();
    if (ImGui::IsItemActive() && moved.norm() > 0 && (middle || !held)) handle_drag(moved);
    if (!ImGui::IsItemHovered()) return;
    if (io.MouseWheel != 0) {
        take_keyboard();
        handle_wheel(c, io.MouseWheel);
    }
    const bool busy = c.place.can_paint() || c.place.view.tool != MeasureTool::None ||
                      outside.has_value() || places.took_click() || handles.has_cursor();
    if (!busy && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) request_centre();
}

void Viewport::Impl::request_centre() {
    if (!target) return;
    Ui plain;  // ids do not depend on colours
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    centring = camera;
    picker.request(scene_view(plain), layers(plain),
                   static_cast<int>(mouse.x + compared.shift_to_model(area, mouse.x) - rect.x),
                   static_cast<int>(rect.height - 1 - (mouse.y - rect.y)));
}

/// The clicked place becomes the centre, unless the view has been moved since.
void Viewport::Impl::take_centre() {
    const auto picked = picker.result();
    if (picked && picked->layer != 0 && centring == camera) camera.centre = picked->point;
}

void Viewport::Impl::handle_keys(const PanelContext& c, bool over_view) {
    if (!over_view) return;
    const KeyCommands& keys = c.shown.keys;
    if (c.place.view.flies) return endoscope.handle_keys(keys);
    for (const auto& [command, side] : kSides)
        if (keys.has(command)) camera = facing(camera, side);
    if (keys.has(KeyCommand::Perspective)) camera.perspective = !camera.perspective;
    if (keys.has(KeyCommand::FrameAll)) frame_model();
}

void Viewport::Impl::draw_toolbar(PanelContext& c) {
    ViewChoice& choice = c.place.view;
    ShownLayers& layers = c.place.settings.layers;
    const float pad = c.ui.grid(0.5F), side = ImGui::GetFrameHeight();
    const bool has_image = c.place.slices().has_image();
    const auto count = has_image ? 8.0F : 7.0F;
    const float width = count * side + (count - 1) * c.ui.grid(0.25F) + 2 * pad;
    const ImVec2 at{area.x + c.ui.grid(1.5F), area.y + c.ui.grid(1.5F)};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 to{at.x + width, at.y + side + 2 * pad};
    draw.AddRectFilled(at, to, faded(c.ui.theme.panel, 0.9), ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorScreenPos({at.x + pad, at.y + pad});
    if (icon_button(c.ui, "view.fit", icons::kFit, "Show everything  Home")) frame_model();
    const ShownLayers before = layers;
    if (draw_tool(c, "view.edges", icons::kGrid, "Triangle edges", layers.edges))
        layers.edges = !layers.edges;
    if (draw_tool(c, "view.flat", icons::kFlat, "Flat shading", layers.flat))
        layers.flat = !layers.flat;
    if (layers != before) c.place.settings.save();
    if (draw_tool(c, "view.transparent", icons::kTransparent, "Transparent", choice.transparent))
        choice.transparent = !choice.transparent;
    const bool coloured = choice.colouring != ColouringKind::Patches;
    if (draw_tool(c, "view.deviation", icons::kPalette,
                  std::string("Colours: ") + colouring_info(choice.last_colouring).label, coloured))
        choice.choose(coloured ? ColouringKind::Patches : choice.last_colouring);
    if (draw_tool(c, "view.perspective", icons::kPerspective, "Perspective  5", camera.perspective))
        camera.perspective = !camera.perspective;
    if (draw_tool(c, "view.options", icons::kLayers, "Colours, sections, overlays and measures  V",
                  c.shown.view))
        c.shown.view = !c.shown.view;
    ImageSlices& slices = c.place.slices();
    if (has_image && draw_tool(c, "view.slices", icons::kImage, "Planes of the image  Shift+I",
                               slices.any_in_space()))
        slices.show_in_space(!slices.any_in_space());
}

/// What the colours mean.
void Viewport::Impl::draw_legend(const PanelContext& c) const {
    if (compared.hides_model()) return;
    ScreenRect place = rect;
    if (compared.colours_model()) place.y += c.ui.em * 1.5F;  // below the comparison's banner
    const bool cells = clip.shows_tetrahedra();
    const ValueRange range = cells ? clip.range() : model.colour_range();
    if (cells || model.shows_colouring()) {
        const ColouringInfo& info = colouring_info(c.place.view.colouring);
        draw_colour_legend(c.ui, place,
                           {ColourMap::Ordered, range.least, range.most,
                            std::string(info.label) + " [" + info.unit + "]"});
    } else if (model.shows_deviation(model_look())) {
        const bool preview = c.place.document.previewed().has_value();
        draw_colour_legend(c.ui, place,
                           {ColourMap::Diverging, range.least, range.most,
                            compared.colours_model() ? "Distance from the reference [mm]"
                            : preview                ? "Distance from the unmodified surface [mm]"
                                                     : "Distance from the source [mm]"});
    }
}

void Viewport::Impl::draw_controls(PanelContext& c) {
    draw_toolbar(c);
    if (model.surface() == nullptr) return draw_empty(c);
    ViewStrips strips(rect);
    clip.draw_strip(c, strips);
    endoscope.draw_strip(c, strips);
    measuring.draw_strip(c, strips);
}

void Viewport::Impl::draw_overlays(PanelContext& c, bool over_view) {
    const OnScreen screen{camera, rect};
    const bool saved = picture.update(c, rect);
    const bool has_model = model.surface() != nullptr;
    if (has_model) overlays.draw_marks(c, screen);
    if (has_content()) {
        places.draw(c, screen);
        handles.draw(c, screen);
    }
    if (has_model) {
        measuring.draw(c, screen);
        draw_edit_marks(c, screen, over_view && !c.place.form());
    }
    if (!saved) draw_controls(c);
    if (!has_content()) return;
    if (has_model) {
        brush.draw(c, camera, rect);
        draw_role_card(c, screen);
    }
    if (!outside) draw_scale_bar(c.ui, rect, camera);
    if (const auto side = draw_orientation(c.ui, rect, camera)) camera = facing(camera, *side);
    compared.draw_labels(c.ui, area);
    draw_legend(c);
}

/// What to do while there is no surface.
void Viewport::Impl::draw_empty(PanelContext& c) const {
    const Scene* scene = c.place.document.shown();
    const bool image = scene != nullptr && scene->image;
    const std::string words = !model.problem().empty() ? "The model cannot be drawn: see Messages"
                              : scene == nullptr || model.pending() ? "Reading the model"
                              : image                               ? "The image has no surface yet"
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
    view.take_centre();
    view.take_look(c.place);
    view.take_comparison(c);
    view.take_scene(c);
    view.guard.run([&] { view.take_slices(c); });
    ImGui::InvisibleButton("view.area", {rect.width, rect.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemAllowOverlap();
    c.ui.item("view.area");
    const bool over = ImGui::IsItemHovered();
    const bool over_model = over && !view.compared.hides_model() &&
                            view.compared.shift_to_model(rect, ImGui::GetIO().MousePos.x) == 0;
    const bool released =
        ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    if (view.model.surface() != nullptr) view.guard.run([&] { view.handle_brush(c); });
    if (view.has_content()) {
        view.handles.update(c, {view.camera, view.rect});
        view.handle_mouse(c);
    }
    view.handle_keys(c, over);
    view.take_choices(c);
    view.guard.run([&] { view.pick_places(c, over_model, released); });
    view.draw_model(c.ui);
    view.guard.tell(c.place.document);
    const ImVec2 to{rect.x + rect.width, rect.y + rect.height};
    if (view.texture != 0)
        ImGui::GetWindowDrawList()->AddImage(
            reinterpret_cast<ImTextureID>(std::uintptr_t{view.texture}), {rect.x, rect.y}, to,
            {0, 1}, {1, 0});
    view.draw_overlays(c, over);
    end_frame();
    if (sliced) view.slice_row.draw(c, {view.renderer, view.planes, view.guard}, row);
}

void Viewport::rest(PanelContext& c) {
    impl_->rest(c);
}

}  // namespace vesselbench
