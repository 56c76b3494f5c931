#include "workbench/window/features/brush/brush_pointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/drawing/region_lines.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr double kFirstRadius = 0.1;      ///< by half the view's height
constexpr double kSizingReach = 150.0;    ///< a drag by this changes the radius by e [pixels]
constexpr double kStrengthReach = 400.0;  ///< or the strength by 1 [pixels]
constexpr int kCircle = 72;               ///< segments

constexpr std::array<std::pair<KeyCommand, BrushKey>, 4> kBrushKeys = {
    {{KeyCommand::SmallerBrush, BrushKey::Smaller},
     {KeyCommand::LargerBrush, BrushKey::Larger},
     {KeyCommand::WeakerBrush, BrushKey::Weaker},
     {KeyCommand::StrongerBrush, BrushKey::Stronger}}};

/// The picked place with the normal of its triangle; none: the background, or it has no normal.
std::optional<StrokePlace> place_of(const Picked& picked, const Surface& surface) {
    if (picked.layer != kModelLayer || picked.element >= surface.triangle_count())
        return std::nullopt;
    const Vec3 normal = area_normal(surface.points(), surface.triangles()[picked.element]);
    if (!(normal.norm() > 0.0)) return std::nullopt;
    return StrokePlace{.point = picked.point, .normal = normal.normalized()};
}

/// A circle in the tangent plane as the view shows it; empty if a part is behind the eye.
std::vector<ImVec2> circle_on_screen(const StrokePlace& place, double radius,
                                     const PixelView& screen) {
    std::vector<ImVec2> line;
    for (const Vec3& point : circle_points(place.point, place.normal, radius, kCircle)) {
        const auto at = screen.place(point);
        if (!at) return {};
        line.emplace_back(static_cast<float>(at->x()), static_cast<float>(at->y()));
    }
    return line;
}

}  // namespace

bool BrushPointer::holds_left() const {
    using enum Stroke::State;
    return stroke_.state() != Idle && stroke_.state() != Turning;
}

void BrushPointer::update(PanelContext& c, const Seen& seen) {
    if (!c.core.get<BrushFeature>().can_paint() && !c.core.get<BrushFeature>().is_painting())
        return leave(c);
    const bool over = ImGui::IsItemHovered() || ImGui::IsItemActive();
    shown_ = over || stroke_.state() == Stroke::State::Painting;
    if (!(c.core.get<BrushFeature>().tip().radius > 0.0))
        c.core.get<BrushFeature>().set_tip(
            scaled({seen.view.camera.half_height, c.core.get<BrushFeature>().tip().strength},
                   kFirstRadius));
    take_answer(c, seen.surface);
    if (stroke_.state() == Stroke::State::Painting && !c.core.document.is_painting())
        stroke_.cancel();
    handle_keys(c, over);
    handle_press(c);
    handle_release(c);
    ask(c, seen, over);
}

void BrushPointer::rest(PanelContext& c) {
    if (stroke_.state() != Stroke::State::Idle && !ImGui::IsMouseDown(ImGuiMouseButton_Left))
        leave(c);
}

/// Another operation, or none: what was painted counts.
void BrushPointer::leave(PanelContext& c) {
    if (stroke_.state() == Stroke::State::Painting) c.core.document.end_stroke();
    forget();
}

void BrushPointer::forget() {
    stroke_.end();
    waiting_.clear();
    released_ = shown_ = false;
    place_.reset();
    asked_.reset();
    picker_.forget();
}

// --- the place under the cursor

/// While a stroke begins or ends, where the button was pressed or released.
BrushPointer::Pixel BrushPointer::wanted_pixel() const {
    if (stroke_.state() == Stroke::State::Deciding) return pressed_at_;
    return released_ ? released_at_ : mouse_pixel();
}

void BrushPointer::ask(PanelContext& c, const Seen& seen, bool over) {
    if (picker_.pending() || sized_) return;
    if (!over && !holds_left()) {
        place_.reset();
        asked_.reset();
        return;
    }
    const Question question{wanted_pixel(), seen.view.camera, seen.surface.positions};
    if (asked_ == question) return extend(c);
    asked_ = question;
    const Eigen::Vector2i pixel = seen.screen.device_pixel(question.pixel);
    picker_.request(seen.view, seen.layers, pixel.x(), pixel.y());
}

void BrushPointer::take_answer(PanelContext& c, const Surface& surface) {
    const auto picked = picker_.result();
    if (!picked) return;
    place_ = place_of(*picked, surface);
    if (asked_ && asked_->pixel == wanted_pixel()) extend(c);
}

// --- the stroke

void BrushPointer::handle_press(PanelContext& c) {
    if (!ImGui::IsItemActive() || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
    const ImGuiIO& io = ImGui::GetIO();
    const Press press{.at = mouse_pixel(), .keys = {.smooth = io.KeyShift, .invert = io.KeyCtrl}};
    if (released_)
        waiting_.push_back(press);
    else
        begin(c, press);
}

void BrushPointer::begin(const PanelContext& c, const Press& press) {
    keys_ = press.keys;
    stroke_.begin(c.core.get<BrushFeature>().tip().radius);
    pressed_at_ = press.at;
    released_ = press.released_at.has_value();
    if (released_) released_at_ = *press.released_at;
    extended_.reset();
}

void BrushPointer::extend(PanelContext& c) {
    const Pixel to = wanted_pixel();
    if (!holds_left() || extended_ == to) return;
    const bool begins = stroke_.state() == Stroke::State::Deciding;
    const auto dabs = stroke_.extend(place_);
    extended_ = to;
    if (begins && stroke_.state() == Stroke::State::Painting)
        c.core.get<BrushFeature>().begin_stroke(keys_);
    for (const StrokePlace& dab : dabs) c.core.document.add_dab(dab);
}

void BrushPointer::handle_release(PanelContext& c) {
    using enum Stroke::State;
    const bool down = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    if (!down && !waiting_.empty() && !waiting_.back().released_at)
        waiting_.back().released_at = mouse_pixel();
    if (stroke_.state() == Idle || (down && !released_)) return;
    if (!released_) released_at_ = mouse_pixel();
    released_ = true;
    const bool painted = stroke_.state() == Painting && extended_ == released_at_;
    if (painted || !holds_left() || stroke_.state() == Dropped) end_stroke(c);
}

/// The next one begins if its press was waiting.
void BrushPointer::end_stroke(PanelContext& c) {
    if (stroke_.state() == Stroke::State::Painting) c.core.document.end_stroke();
    stroke_.end();
    released_ = false;
    if (waiting_.empty()) return;
    begin(c, waiting_.front());
    waiting_.pop_front();
}

// --- radius and strength

void BrushPointer::handle_keys(PanelContext& c, bool over) {
    if (over || sized_) handle_sizing(c);
    if (!over) return;
    for (const auto& [command, key] : kBrushKeys)
        if (c.shown.keys.has(command))
            c.core.get<BrushFeature>().set_tip(after_key(c.core.get<BrushFeature>().tip(), key));
}

/// While F is held, the mouse changes the radius, with Shift the strength.
void BrushPointer::handle_sizing(PanelContext& c) {
    if (!c.shown.keys.has(KeyCommand::SizeBrush) || holds_left()) return sized_.reset();
    if (!sized_) {
        sized_ = c.core.get<BrushFeature>().tip();
        sized_from_ = mouse_pixel().x();
    }
    const double moved = mouse_pixel().x() - sized_from_;
    if (moved == 0) return;
    BrushTip tip = *sized_;
    if (ImGui::GetIO().KeyShift)
        tip = with_strength(tip, std::abs(tip.strength) + moved / kStrengthReach);
    else
        tip = scaled(tip, std::exp(moved / kSizingReach));
    c.core.get<BrushFeature>().set_tip(tip);
}

// --- drawing

void BrushPointer::draw(const PanelContext& c, const PixelView& screen) const {
    if (!c.core.get<BrushFeature>().can_paint()) return;
    const ScreenRect rect = rect_of(screen);
    const BrushTip tip = c.core.get<BrushFeature>().tip();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const std::string words = readable(c.core.form()->operation().name) +
                              formatted(tip.radius, ": radius %g mm") +
                              formatted(tip.strength, ", strength %g");
    draw_hint(c.ui, rect, words);
    if (!shown_ || !place_) return;
    const auto circle = circle_on_screen(*place_, tip.radius, screen);
    const auto count = static_cast<int>(circle.size());
    const float thick = std::max(1.5F, c.ui.em / 9);
    draw.AddPolyline(circle.data(), count, faded(paint(0x000000), 0.5), ImDrawFlags_Closed,
                     2 * thick);
    draw.AddPolyline(circle.data(), count, paint(0xFFFFFF), ImDrawFlags_Closed, thick);
}

}  // namespace vesselbench
