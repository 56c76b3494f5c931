#include "workbench/window/features/live/live_feature.h"

#include <utility>

#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/live/live_banner.h"

namespace vesselbench {

LiveSmoothing::Followed LiveFeature::followed() const {
    return {
        .document = core_.document, .form = core_.open_form(), .colouring = core_.view.colouring};
}

bool LiveFeature::can_drive() const {
    const OperationForm* form = core_.open_form();
    return form != nullptr && form->valid() && core_.armed().empty() && live_.can_follow() &&
           core_.document.can(RequestKind::Preview) && core_.view.tool == ClickTool::None &&
           !core_.get<CompareFeature>().comparison();
}

void LiveFeature::begin_driving() {
    if (!can_drive()) return;
    core_.want_model();
    driven_ = core_.begin_drag();
    core_.document.drop_preview();
    live_.begin_drive();
}

void LiveFeature::drive(const DriveReach& reach) {
    if (is_driving() && live_.can_follow()) core_.drag(live_.drive(*core_.before_drag(), reach));
}

bool LiveFeature::update() {
    tell_difference();
    const bool changed = live_.update(followed());
    tell_fallback();
    return changed;
}

/// What was applied is computed by the CPU, and taken back where it would cross itself: a user who
/// saw something else is told.
void LiveFeature::tell_difference() {
    Document& document = core_.document;
    if (!applied_live_ || core_.form() || document.is_reading()) return;
    const Scene* scene = document.current();
    if (scene == nullptr || !scene->surface || scene->surface->positions == applied_to_) return;
    const std::shared_ptr<const LiveModel> seen = std::exchange(applied_live_, nullptr);
    const std::string difference = difference_text(seen->state.surface, *scene->surface);
    if (difference.empty()) return;
    document.tell(make_message(MessageKind::Remark,
                               "The result differs from the live preview by " + difference));
}

/// Slower previews have a reason.
void LiveFeature::tell_fallback() {
    if (told_fallback_ || !live_.model() || live_.model()->reason.empty()) return;
    told_fallback_ = true;
    core_.document.tell(make_message(
        MessageKind::Remark, "Live smoothing continues on the CPU: " + live_.model()->reason));
}

float LiveFeature::banner(PanelContext& context, const ScreenRect& place) {
    if (!live_.follows() || core_.document.previewed()) return 0.0F;
    return draw_live_banner(context, live_, place);
}

void LiveFeature::form_dropped() {
    live_.follow(false);
    applied_live_.reset();
    applied_to_.reset();
}

void LiveFeature::drag_undone() {
    if (driven_ != 0 && driven_ == core_.drags()) live_.cancel_drag();
    driven_ = 0;
}

void LiveFeature::applying() {
    applied_live_ = live_.shown();
    applied_to_ = applied_live_ ? core_.document.current()->surface->positions : nullptr;
}

}  // namespace vesselbench
