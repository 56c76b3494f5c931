#include "workbench/window/features/compare/compare_feature.h"

#include "workbench/window/features/compare/comparison_banner.h"

namespace vesselbench {

void CompareFeature::compare(const Reference& reference) {
    compare(reference, comparison_ ? comparison_->mode() : mode_);
}

void CompareFeature::compare(const Reference& reference, CompareMode mode) {
    const bool again = comparison_ && comparison_->reference() == reference;
    stop();
    core_.claim_view(*this);
    if (!again && core_.document.is_open()) comparison_.emplace(reference, mode, core_.wake());
}

void CompareFeature::stop() {
    if (comparison_) mode_ = comparison_->mode();
    comparison_.reset();
}

bool CompareFeature::update() {
    return comparison_ && core_.document.is_open() && comparison_->update(core_.document);
}

bool CompareFeature::pending() const {
    return comparison_ && comparison_->pending();
}

float CompareFeature::banner(PanelContext& context, const ScreenRect& place) {
    if (!comparison_) return 0.0F;
    ScreenRect rect = place;
    rect.height = comparison_banner_height(context.ui);
    if (draw_comparison_banner(context, *comparison_, rect)) stop();
    return rect.height;
}

}  // namespace vesselbench
