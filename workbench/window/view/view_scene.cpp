#include "workbench/window/view/view_scene.h"

#include <algorithm>

#include <imgui.h>

#include "gpu/device.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/brush/brush_form.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

constexpr double kLinePull = 0.01;  ///< of lines on the surface, by half the view's height [-]

ViewLook look_of(const Workplace& place) {
    return {.edges = place.settings.layers.edges,
            .flat = place.settings.layers.flat,
            .transparent = place.view.transparent,
            .deviation = place.view.colouring == ColouringKind::Deviation};
}

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

std::optional<ValueRange> live_range(const LiveModel& live) {
    return live.colours ? std::optional(live.colours->range) : range_of(live.deviation);
}

double line_width(const Ui& ui) {
    return std::max(1.0, ui.em / 15.0);
}

/// What follows a form; null: nothing does.
std::shared_ptr<const Surface> followed_surface(const Workplace& place) {
    if (const auto& live = place.live().shown()) return {live, &live->state.surface};
    if (const auto& found = place.extraction().shown()) return {found, &found->state.surface};
    return nullptr;
}

int pixels(float length) {
    return std::max(1, static_cast<int>(length));
}

}  // namespace

ViewScene::ViewScene(const std::function<void()>& wake, DrawingGuard& guard)
    : guard_(guard),
      model_(wake),
      compared_(wake),
      gallery_(wake),
      branch_(wake),
      clip_(wake),
      overlays_(wake) {}

bool ViewScene::pending() const {
    return model_.pending() || compared_.pending() || gallery_.pending() || branch_.pending() ||
           clip_.pending() || overlays_.pending();
}

void ViewScene::forget(PanelContext& c) {
    model_.show(nullptr);
    static_cast<void>(model_.update());
    compared_.forget();
    gallery_.forget();
    branch_.update(nullptr, nullptr, {});
    clip_.forget();
    overlays_.forget();
    region_.show({});
    planes_.update(c.place.slices());
    image_box_.reset();
    seen_scenes_ = -1;
    live_.reset();
    followed_.reset();
    target_.reset();
    texture_ = 0;
    drawn_.reset();
}

// --- following the case

ViewScene::Change ViewScene::update(PanelContext& c, const ScreenRect& area) {
    const bool room = take_room(c, area);
    const bool another = take_model(c);
    guard_.run([&] { take_planes(c); });
    guard_.note(model_.problem());
    guard_.note(compared_.problem());
    guard_.note(gallery_.problem());
    const bool image = image_box_ && surface() == nullptr && !model_.pending();
    if (another || image) return Change::Model;
    return room ? Change::Room : Change::None;
}

/// What is compared, or offered. \return true if it leaves another room to the model in the same
/// view
bool ViewScene::take_room(PanelContext& c, const ScreenRect& area) {
    compared_.update(c);
    guard_.run([&] { gallery_.update(c, area); });
    const bool resized = area.width != area_.width;
    const float before = rect_.width;
    area_ = area;
    rect_ = gallery_.is_on() ? gallery_.room_for_model() : compared_.room_for_model(area);
    return before != rect_.width && !resized;
}

/// \return true if another surface is shown
bool ViewScene::take_model(PanelContext& c) {
    Document& document = c.place.document;
    const auto followed = followed_surface(c.place);
    if (seen_scenes_ != document.scene_changes() || (followed_ && !followed)) {
        seen_scenes_ = document.scene_changes();
        static_cast<void>(document.take_moves());
        model_.show(document.shown());
        drawn_.reset();
    }
    for (const SceneMove& move : document.take_moves()) model_.move(move);
    if (followed && followed != followed_) model_.reshape(*followed);
    followed_ = followed;
    live_ = c.place.live().shown();
    choose_colours(c);
    const bool first = surface() == nullptr;
    if (!model_.update()) return false;
    drawn_.reset();
    ++models_;
    return model_.is_new() && (!followed_ || first);
}

void ViewScene::choose_colours(PanelContext& c) {
    Document& document = c.place.document;
    const auto& form = c.place.form();
    model_.set_painted(form ? painted_attribute(*form) : "");
    look_ = look_of(c.place);
    document.want_deviation(look_.deviation);
    model_.set_deviation(live_                       ? live_->deviation
                         : compared_.colours_model() ? compared_.difference()
                                                     : document.deviation());
    const auto& colours = c.place.view_data().colours();
    const bool on_model =
        colours && !compared_.colours_model() && colours->kind != ColouringKind::TetrahedraQuality;
    model_.set_colouring(live_ ? live_->colours : on_model ? colours : nullptr);
    c.place.view.draw_as({c.place.view.colouring, compared_.colours_model()},
                         live_ ? live_range(*live_) : automatic_range(c.place, compared_));
    model_.set_range(c.place.view.range());
}

void ViewScene::take_planes(PanelContext& c) {
    planes_.update(c.place.slices());
    const SliceGrid& grid = c.place.slices().grid();
    image_box_.reset();
    if (planes_.any_in_space()) image_box_ = Bounds{grid.low, grid.high()};
}

void ViewScene::look_from(const ViewCamera& camera, bool inside) {
    camera_ = camera;
    inside_ = inside;
}

void ViewScene::choose(PanelContext& c, const Choices& choices) {
    lit_patch_ = choices.lit_patch;
    const auto& form = c.place.form();
    const bool previews = c.place.document.previewed().has_value();
    guard_.run(
        [&] { region_.show(form && has_content() ? choices.lines : std::vector<RegionLine>()); });
    guard_.run(
        [&] { branch_.update(form && !previews ? &*form : nullptr, surface(), choices.spot); });
    guard_.run([&] { clip_.update(c, surface(), camera_); });
    guard_.run([&] { overlays_.update(c); });
}

// --- drawing

ViewLook ViewScene::model_look() const {
    ViewLook own = look_;
    own.deviation = look_.deviation || compared_.colours_model();
    return own;
}

Layers ViewScene::layers(const Ui& ui) const {
    return layers_as(model_look(), ui);
}

Layers ViewScene::layers_as(const ViewLook& look, const Ui& ui) const {
    const double line = line_width(ui);
    Layers layers = model_.layers(look, line);
    for (SurfaceLayer& layer : layers.surfaces) {
        layer.highlighted_patch = lit_patch_;
        layer.back_as_front = inside_;
    }
    planes_.add_to(layers, line);
    clip_.add_to(layers, line);
    overlays_.add_to(layers, line, ui.theme.dark);
    const double pull = kLinePull * camera_.half_height;
    branch_.add_to(layers, pull / 2);
    region_.add_to(layers, 2 * line, pull);
    return layers;
}

SceneView ViewScene::scene_view(const Ui& ui) const {
    return {.camera = camera_,
            .rectangle = {0, 0, pixels(rect_.width), pixels(rect_.height)},
            .clip = clip_.plane(),
            .background = Background{linear(ui.theme.view_above), linear(ui.theme.view_below)}};
}

ViewScene::DrawnAs ViewScene::now(const Ui& ui) const {
    return {.camera = camera_,
            .look = look_,
            .width = pixels(area_.width),
            .height = pixels(area_.height),
            .dark = ui.theme.dark,
            .lit_patch = lit_patch_,
            .region = region_.version(),
            .branch = branch_.version(),
            .slices = planes_.space_version(),
            .compared = compared_.version(),
            .gallery = gallery_.version(),
            .range = model_.colour_range(),
            .clip = clip_.version(),
            .overlays = overlays_.version(),
            .inside = inside_};
}

unsigned ViewScene::draw(Renderer& renderer, const Ui& ui) {
    if (guard_.run([&] { draw_picture(renderer, ui); })) return texture_;
    drawn_.reset();
    texture_ = 0;
    return 0;
}

Picture ViewScene::picture(Renderer& renderer, const Ui& ui, int factor,
                           const std::optional<Colour>& background) const {
    Ui scaled;  // lines get wider with the picture
    scaled.theme = background ? light_theme() : ui.theme;
    scaled.em = ui.em * static_cast<float>(factor);
    SceneView view = scene_view(scaled);
    view.rectangle.width *= factor;
    view.rectangle.height *= factor;
    if (background) view.background = Background{*background, *background};
    RenderTarget target(view.rectangle.width, view.rectangle.height);
    target.bind();
    renderer.draw(view, layers(scaled));
    return target.picture();
}

/// Drawn by the processor, a picture without smooth edges and of fewer triangles takes a fraction
/// of the time: what the mouse moves follows it better so, and is drawn again when it is let go.
bool ViewScene::is_hurried() {
    if (!in_software_) in_software_ = draws_in_software();
    return *in_software_ && ImGui::IsAnyMouseDown();
}

/// The camera has moved while a button is held.
bool ViewScene::turns() const {
    return drawn_ && (drawn_->look.coarse || drawn_->camera != camera_);
}

void ViewScene::draw_picture(Renderer& renderer, const Ui& ui) {
    const bool hurried = is_hurried();
    DrawnAs wanted = now(ui);
    wanted.look.coarse = hurried && turns();
    const int samples = hurried ? 0 : RenderTarget::kSamples;
    if (drawn_ == wanted && samples <= samples_) return;
    if (!target_) target_.emplace(wanted.width, wanted.height, samples);
    target_->resize(wanted.width, wanted.height, samples);
    target_->bind();
    SceneView view = scene_view(ui);
    view.rectangle.x = static_cast<int>(rect_.x - area_.x);
    ViewLook look = model_look();
    look.coarse = wanted.look.coarse;
    if (!hides_model()) renderer.draw(view, layers_as(look, ui));
    compared_.draw(renderer, view, wanted.look, line_width(ui));
    gallery_.draw(renderer, view, wanted.look, line_width(ui));
    texture_ = target_->resolve();
    drawn_ = wanted;
    samples_ = samples;
    ++drawings_;
}

}  // namespace vesselbench
