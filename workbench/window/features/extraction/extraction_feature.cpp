#include "workbench/window/features/extraction/extraction_feature.h"

#include "workbench/window/features/extraction/extraction_banner.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/features/slices/slices_feature.h"

namespace vesselbench {

void ExtractionFeature::follow(bool on) {
    extraction_.follow(on);
    if (extraction_.follows()) core_.get<SlicesFeature>().slices().lend_row(true);
}

void ExtractionFeature::begin_sliding() {
    if (!core_.form() || !extraction_.can_follow() || !core_.document.can(RequestKind::Preview))
        return;
    slid_ = core_.begin_drag();
    core_.document.drop_preview();
    extraction_.begin_drag();
    core_.get<SlicesFeature>().slices().lend_row(true);
}

void ExtractionFeature::slide(double iso) {
    if (is_sliding()) core_.drag(extraction_.iso_texts(*core_.before_drag(), iso));
}

/// The outline in the slices is that of the surface in the view.
bool ExtractionFeature::update() {
    const bool changed = extraction_.update(core_.get<LiveFeature>().followed());
    const auto& shown = extraction_.shown();
    core_.get<SlicesFeature>().outline(
        shown ? std::shared_ptr<const Surface>(shown, &shown->state.surface) : nullptr);
    return changed;
}

float ExtractionFeature::banner(PanelContext& context, const ScreenRect& place) {
    if (!extraction_.follows() || core_.document.previewed()) return 0.0F;
    return draw_extraction_banner(context, extraction_, place);
}

void ExtractionFeature::drag_undone() {
    if (slid_ != 0 && slid_ == core_.drags()) extraction_.cancel_drag();
    slid_ = 0;
}

}  // namespace vesselbench
