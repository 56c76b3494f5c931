#include "workbench/window/features/picking/view_places.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/core/core.h"
#include "workbench/window/drawing/model_drawing.h"
#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/form/picked_text.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kMarkReach = 1.2F;  ///< a cursor so near to a mark means its place [em]

std::vector<NamedPlace> offered_for(PickTarget target, const SurfacePlaces& places) {
    switch (target) {
        case PickTarget::Tip:
        case PickTarget::Ends:
            return places.tips;
        case PickTarget::Opening:
            return openings_and_tips(places);
        default:
            return {};
    }
}

/// The places of all parameters of a form.
std::vector<NamedPlace> offered_in(const OperationForm& form, const SurfacePlaces& places) {
    std::vector<NamedPlace> offered;
    for (const FormField& field : form.fields()) {
        const auto target = pick_target(*field.parameter);
        if (!target || !field.active) continue;
        for (NamedPlace& place : offered_for(*target, places))
            if (std::ranges::count(offered, place) == 0) offered.push_back(std::move(place));
    }
    return offered;
}

std::string coordinates(const Vec3& point) {
    return formatted(point.x(), "%.1f") + ", " + formatted(point.y(), "%.1f") + ", " +
           formatted(point.z(), "%.1f");
}

/// What is armed, unless it is picked in slices only.
std::optional<PickTarget> target_in_view(const Core& place) {
    const std::optional<PickTarget> target = place.armed_target();
    return target && !is_in_slices(*target) ? target : std::nullopt;
}

}  // namespace

ViewPlaces::ViewPlaces(Renderer& renderer, std::function<void()> wake)
    : picker_(renderer), wake_(std::move(wake)) {}

bool ViewPlaces::took_click() const {
    return ImGui::GetTime() - click_time_ < 2.0 * ImGui::GetIO().MouseDoubleClickTime;
}

std::optional<Vec3> ViewPlaces::hit() const {
    if (!answer_ || answer_->picked.layer != kModelLayer) return std::nullopt;
    return answer_->picked.point;
}

void ViewPlaces::forget() {
    picker_.forget();
    clicked_.reset();
    answer_.reset();
    spot_.reset();
    lit_patch_.reset();
}

void ViewPlaces::search(const SeenModel& seen, const Question& now) {
    // An answer to another view or model is of no use; one to a place nearby is, until the next.
    if (answer_ &&
        (answer_->question.camera != now.camera || answer_->question.version != now.version))
        answer_.reset();
    const bool known = answer_ && answer_->question == now;
    if (!known && !picker_.pending()) {
        asked_ = now;
        const Eigen::Vector2i pixel = seen.screen.device_pixel(now.cursor);
        picker_.request(seen.view, seen.layers, pixel.x(), pixel.y());
    }
    if (picker_.pending() && wake_) wake_();
}

void ViewPlaces::find_spot(const SeenModel& seen, const ViewPixel& cursor, double reach) {
    spot_ = pick_spot(offered_, hit(), nearest_mark(seen.screen, offered_, cursor, reach));
}

void ViewPlaces::light_opening(const PanelContext& c, const SeenModel& seen) {
    lit_patch_.reset();
    if (!hit() || answer_->picked.element >= seen.surface->triangle_count()) return;
    const std::uint32_t label = (*seen.surface->patch_labels)[answer_->picked.element];
    if (opening_of(c.core.surface_places(), label) != nullptr) lit_patch_ = label;
}

void ViewPlaces::update(PanelContext& c, const SeenModel& seen) {
    if (const auto picked = picker_.result()) answer_ = Answer{asked_, *picked};
    if (c.core.has_click_tool()) {
        c.core.get<OpeningsFeature>().forget_role_question();
        return forget();
    }
    const SurfacePlaces& places = c.core.surface_places();
    const std::optional<PickTarget> target = target_in_view(c.core);
    if (seen.clicked) {
        clicked_ = mouse_pixel();
        c.core.get<OpeningsFeature>().forget_role_question();
        if (target) click_time_ = ImGui::GetTime();
    }
    const ViewPixel cursor = clicked_.value_or(mouse_pixel());
    const bool wanted = !c.core.get<BrushFeature>().can_paint() &&
                        (target || may_be_over(seen.screen, places.openings, cursor));
    if (seen.surface == nullptr || !wanted || !(seen.over || clicked_)) return forget();
    const Question now{cursor, seen.view.camera, seen.version};
    search(seen, now);
    light_opening(c, seen);
    if (target) {
        offered_ = offered_for(*target, places);
        find_spot(seen, cursor, kMarkReach * c.ui.em);
    } else {
        spot_.reset();
    }
    if (!clicked_ || !answer_ || answer_->question != now) return;
    clicked_.reset();
    take_click(c);
}

void ViewPlaces::take_click(PanelContext& c) {
    if (c.core.armed_target()) {
        if (spot_) c.core.pick(spot_->point);
        return;
    }
    if (!lit_patch_) return;
    if (const PatchMeasures* opening = opening_of(c.core.surface_places(), *lit_patch_))
        c.core.get<OpeningsFeature>().click(*opening);
    if (!c.core.get<OpeningsFeature>().role_question()) click_time_ = ImGui::GetTime();
}

void ViewPlaces::draw_offered(const PanelContext& c, const PixelView& screen) const {
    // The markers of all ends say more.
    if (!c.core.get<OpeningsFeature>().openings().rows().empty() && !c.core.armed_target()) return;
    for (const NamedPlace& place : offered_in(*c.core.form(), c.core.surface_places()))
        if (const auto at = screen.place(place.point)) draw_mark(c.ui, *at, MarkLook::Offered, "");
    for (const NamedPlace& place : places_in(*c.core.form()))
        if (const auto at = screen.place(place.point))
            draw_mark(c.ui, *at, MarkLook::Picked, place.name);
}

void ViewPlaces::draw_spot(const PanelContext& c, const PixelView& screen) const {
    if (!spot_ || !c.core.armed_target()) return;
    const auto at = screen.place(spot_->point);
    if (!at) return;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    const bool named = spot_->place && *spot_->place < offered_.size();
    draw_mark(c.ui, *at, MarkLook::Lit,
              named ? offered_[*spot_->place].name : coordinates(spot_->point));
}

void ViewPlaces::draw_opening(PanelContext& c) const {
    if (!lit_patch_ || c.core.armed_target() || c.core.get<OpeningsFeature>().role_question())
        return;
    const PatchMeasures* opening = opening_of(c.core.surface_places(), *lit_patch_);
    if (opening == nullptr) return;
    c.ui.item("view.opening." + opening->name, spot_rect(mouse_pixel()));
    tooltip(c.ui, opening_text(*opening));
}

void ViewPlaces::draw(PanelContext& c, const PixelView& screen) const {
    draw_opening(c);
    if (!c.core.form()) return;
    draw_offered(c, screen);
    draw_spot(c, screen);
    const SurfacePlaces& places = c.core.surface_places();
    const auto target = c.core.armed_target();
    if (c.core.searches_places() && wants_tips(*c.core.form()))
        draw_hint(c.ui, rect_of(screen), "Finding vessel ends");
    else if (target)
        draw_hint(c.ui, rect_of(screen),
                  pick_instruction(*target) + "    Esc: stop picking" +
                      (places.problem.empty() ? "" : "    (" + places.problem + ")"));
}

}  // namespace vesselbench
