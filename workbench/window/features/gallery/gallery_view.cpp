#include "workbench/window/features/gallery/gallery_view.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "gpu/picture.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kSpotShare = 0.36F;       ///< of the view's width, for magnified spots
constexpr double kEdgesAcross = 22.0;     ///< of the original, in a magnified spot
constexpr double kZoomPerNotch = 1.15;    ///< of the wheel
constexpr double kMostZoom = 8.0;         ///< up, or down
constexpr double kWirePull = 0.02;        ///< of the wireframe, by half the view's height [-]
constexpr double kUnknownOpacity = 0.25;  ///< of the original in place of what is searched [-]
constexpr std::array kNames = {"Little", "Medium", "Strong"};

/// "Iterations 12, lambda 0.4"
std::string values_text(const PresetSuggestion& suggestion) {
    if (suggestion.does_nothing) return "Leaves the surface as it is";
    std::vector<std::string> words;
    for (const char* name : filter_values())
        if (suggestion.arguments.has(name))
            words.push_back(std::string(name) + " " + formatted(suggestion.arguments.real(name)));
    return readable_sentence(joined(words));
}

/// Its lines are not broken within a figure.
std::string figures_text(const PresetSuggestion& suggestion) {
    return formatted(suggestion.error, "Error\u00A0%.2g\u00A0mm, ") +
           formatted(suggestion.curvature_percent, "curvature\u00A0%.0f\u00A0%%, ") +
           formatted(suggestion.volume_change_percent, "volume\u00A0%+.2f\u00A0%%");
}

/// What a plate says below its name, in lines of a width.
std::string plate_text(const PresetSuggestion& suggestion, float width) {
    return broken(values_text(suggestion), width) + "\n" + broken(figures_text(suggestion), width);
}

std::string take_help(const PresetSuggestion& suggestion) {
    return "Fill in these values, as a double click on the model does\n" + values_text(suggestion) +
           "\n" + figures_text(suggestion);
}

std::string plate_title(const SuggestionGallery& gallery, std::size_t i, bool found) {
    const std::string name = kNames[i];
    if (found) return name;
    return name + (gallery.problem().empty() ? ": searching" : ": not found");
}

bool holds(const ScreenRect& rect, const ImVec2& at) {
    return at.x >= rect.x && at.x < rect.x + rect.width && at.y >= rect.y &&
           at.y < rect.y + rect.height;
}

bool show_in(ModelDrawing& drawing, const Surface* surface) {
    Scene scene;
    if (surface != nullptr) scene.surface = *surface;
    drawing.show(surface != nullptr ? &scene : nullptr);
    return true;
}

}  // namespace

float magnified_width(const ScreenRect& view) {
    return std::floor(view.width * kSpotShare);
}

GalleryView::GalleryView(const std::function<void()>& wake)
    : models_{ModelDrawing(wake), ModelDrawing(wake), ModelDrawing(wake)}, original_(wake) {}

// --- following

void GalleryView::update(PanelContext& c, const ScreenRect& view) {
    const SuggestionGallery& gallery = c.core.get<GalleryFeature>().gallery();
    view_ = view;
    if (mode_ != gallery.mode()) ++version_;
    mode_ = gallery.mode();
    if (!is_on()) return forget();
    take_models(gallery);
    take_original(gallery);
    take_spot(gallery);
    bool changed = original_.update();
    for (ModelDrawing& model : models_) changed = model.update() || changed;
    if (changed) ++version_;
}

void GalleryView::take_models(const SuggestionGallery& gallery) {
    for (std::size_t i = 0; i < models_.size(); ++i) {
        const auto suggestion = gallery.suggestion(i);
        if (suggestion == shown_[i]) continue;
        shown_[i] = suggestion;
        show_in(models_[i], suggestion ? &suggestion->surface : nullptr);
        ++version_;
    }
}

void GalleryView::take_original(const SuggestionGallery& gallery) {
    if (original_of_ == gallery.original()) return;
    original_of_ = gallery.original();
    if (original_of_) edge_ = mean_edge_length(*original_of_);
    show_in(original_, original_of_.get());
}

void GalleryView::take_spot(const SuggestionGallery& gallery) {
    const Spot* chosen = gallery.spots.chosen();
    const auto spot = chosen != nullptr ? std::optional(*chosen) : std::nullopt;
    if (spot == spot_) return;
    spot_ = spot;
    ++version_;
}

void GalleryView::forget() {
    for (ModelDrawing& model : models_) {
        if (model.surface() != nullptr || model.pending()) model.show(nullptr);
        static_cast<void>(model.update());
    }
    if (original_.surface() != nullptr || original_.pending()) original_.show(nullptr);
    static_cast<void>(original_.update());
    shown_ = {};
    original_of_.reset();
    spot_.reset();
    magnification_ = 1.0;
    plates_ = 0.0F;
    mode_ = GalleryMode::Off;
}

bool GalleryView::pending() const {
    return original_.pending() || std::ranges::any_of(models_, &ModelDrawing::pending);
}

std::string GalleryView::problem() const {
    for (const ModelDrawing& model : models_)
        if (!model.problem().empty()) return model.problem();
    return original_.problem();
}

// --- where

/// The last one of a row or column takes what is left by rounding.
ScreenRect GalleryView::cell(std::size_t i) const {
    const auto number = static_cast<float>(i);
    const auto count = static_cast<float>(models_.size());
    const bool last = i + 1 == models_.size();
    if (mode_ == GalleryMode::Models) {
        const float wide = std::floor(view_.width / count);
        return {view_.x + number * wide, view_.y, last ? view_.width - number * wide : wide,
                view_.height};
    }
    const float wide = magnified_width(view_);
    const float high = std::floor(view_.height / count);
    return {view_.x + view_.width - wide, view_.y + number * high, wide,
            last ? view_.height - number * high : high};
}

ScreenRect GalleryView::room_for_model() const {
    if (mode_ == GalleryMode::Models) return cell(0);
    if (mode_ == GalleryMode::Off) return view_;
    return {view_.x, view_.y, view_.width - cell(0).width, view_.height};
}

float GalleryView::shift_to_model(float x) const {
    if (mode_ != GalleryMode::Models) return 0.0F;
    const float wide = cell(0).width;
    const float column = std::floor((x - view_.x) / std::max(wide, 1.0F));
    return -std::clamp(column, 0.0F, static_cast<float>(models_.size() - 1)) * wide;
}

std::optional<std::size_t> GalleryView::cell_at_mouse() const {
    if (!is_on()) return std::nullopt;
    for (std::size_t i = 0; i < models_.size(); ++i)
        if (holds(cell(i), ImGui::GetIO().MousePos)) return i;
    return std::nullopt;
}

/// Its rows are counted from below.
PixelRectangle GalleryView::pixels_of(const ScreenRect& cell) const {
    const auto whole = [](float length) { return static_cast<int>(std::lround(length)); };
    return {whole(cell.x - view_.x), whole(view_.y + view_.height - cell.y - cell.height),
            std::max(1, whole(cell.width)), std::max(1, whole(cell.height))};
}

ScreenRect GalleryView::above_plates(ScreenRect part) const {
    if (hides_model()) part.y -= plates_;
    return part;
}

void GalleryView::zoom(double notches) {
    if (notches == 0.0) return;
    magnification_ =
        std::clamp(magnification_ * std::pow(kZoomPerNotch, notches), 1.0 / kMostZoom, kMostZoom);
    ++version_;
}

// --- drawing

/// Whole models are seen by the view's camera; a spot from outside, from right before it.
SceneView GalleryView::view_of(const SceneView& scene) const {
    SceneView own = scene;
    if (mode_ == GalleryMode::Models) return own;
    own.clip.reset();
    if (!spot_) return own;
    own.camera = {.centre = spot_->point,
                  .view = -spot_->normal,
                  .up = upward_for(-spot_->normal),
                  .half_height = 0.5 * kEdgesAcross * edge_ / magnification_};
    return own;
}

Layers GalleryView::layers_of(std::size_t i, const ViewLook& look, double edge_width,
                              const SceneView& view) const {
    if (magnifies() && !spot_) return {};
    Layers layers = models_[i].layers(look, edge_width);
    const bool known = !layers.surfaces.empty();
    if (known && !magnifies()) return layers;
    for (SurfaceLayer& layer : original_.layers(look, edge_width).surfaces) {
        layer.id = 0;
        if (known) {
            layer.edges = Edges::Only;
            layer.pull = kWirePull * view.camera.half_height;
        } else {
            layer.opacity = kUnknownOpacity;
        }
        layers.surfaces.push_back(std::move(layer));
    }
    return layers;
}

void GalleryView::draw(Renderer& renderer, const SceneView& scene, ViewLook look,
                       double edge_width) const {
    if (!is_on()) return;
    look.deviation = false;
    look.edges = look.edges && !magnifies();
    SceneView own = view_of(scene);
    for (std::size_t i = 0; i < models_.size(); ++i) {
        own.rectangle = pixels_of(cell(i));
        renderer.draw(own, layers_of(i, look, edge_width, own));
    }
}

// --- plates

/// Beside the model it leaves out the figures: they would cover the spot.
/// \return its height with the margins
float GalleryView::draw_plate(PanelContext& c, const ScreenRect& part, std::size_t i) const {
    const Ui& ui = c.ui;
    const auto& found = shown_[i];
    const float margin = ui.grid(0.75F), pad = ui.grid(0.75F);
    const std::string title =
        plate_title(c.core.get<GalleryFeature>().gallery(), i, found != nullptr);
    const float button_wide = ui.em * 4, room = part.width - 2 * (margin + pad);
    const float narrow = ImGui::CalcTextSize(title.c_str()).x + ui.em + button_wide;
    const float wide = magnifies() ? std::min(narrow, room) : room;
    ImGui::PushFont(ui.fonts.small);
    const std::string words = found && hides_model() ? plate_text(*found, wide) : "";
    const float text_high = !words.empty() ? ImGui::CalcTextSize(words.c_str()).y + pad : 0.0F;
    ImGui::PopFont();
    // The name is not cut: the button goes below where it has no room beside it.
    const bool beside = narrow <= wide;
    const float row = ImGui::GetFrameHeight();
    const float high = row + text_high + 2 * pad + (beside ? 0.0F : row + pad);
    const ImVec2 from{part.x + margin, part.y + part.height - high - margin};
    ImGui::GetWindowDrawList()->AddRectFilled(from, {from.x + wide + 2 * pad, from.y + high},
                                              faded(ui.theme.panel, 0.9),
                                              ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorScreenPos({from.x + pad, from.y + pad});
    ImGui::AlignTextToFramePadding();
    text(ui, title, ui.theme.text);
    const float below = from.y + pad + ImGui::GetFrameHeight() + pad;
    ImGui::GetWindowDrawList()->AddText(ui.fonts.small, ui.fonts.small->FontSize,
                                        {from.x + pad, below}, ui.theme.muted, words.c_str());
    ImGui::SetCursorScreenPos(
        {from.x + pad + wide - button_wide, beside ? from.y + pad : from.y + high - pad - row});
    const std::string name = "gallery.take." + std::to_string(i);
    if (found && button(c.ui, name, "Take", {.width = button_wide, .help = take_help(*found)}))
        c.core.get<GalleryFeature>().take(i);
    return high + 2 * margin;
}

void GalleryView::draw_borders(PanelContext& c) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < models_.size(); ++i) {
        const ScreenRect part = cell(i);
        const ImVec2 corner{part.x, part.y};
        if (magnifies() || i > 0)
            draw.AddLine(corner, {part.x, part.y + part.height}, c.ui.theme.border);
        if (magnifies() && i > 0)
            draw.AddLine(corner, {part.x + part.width, part.y}, c.ui.theme.border);
        c.ui.item("gallery.cell." + std::to_string(i), part);
    }
}

void GalleryView::draw_plates(PanelContext& c) {
    if (!is_on()) return;
    draw_borders(c);
    plates_ = 0.0F;
    for (std::size_t i = 0; i < models_.size(); ++i)
        plates_ = std::max(plates_, draw_plate(c, cell(i), i));
}

}  // namespace vesselbench
