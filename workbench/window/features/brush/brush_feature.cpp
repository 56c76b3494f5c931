#include "workbench/window/features/brush/brush_feature.h"

#include "workbench/window/features/brush/brush_form.h"

namespace vesselbench {

bool BrushFeature::has_brush() const {
    return core_.form() && is_brush(core_.form()->operation());
}

bool BrushFeature::can_paint() const {
    return has_brush() && core_.armed().empty() && !core_.form()->edit() && core_.form()->valid() &&
           core_.view.tool == ClickTool::None && core_.document.can_paint();
}

bool BrushFeature::is_painting() const {
    return has_brush() && core_.document.is_painting();
}

BrushTip BrushFeature::tip() const {
    return core_.form() ? tip_of(*core_.form(), tip_) : tip_;
}

void BrushFeature::set_tip(const BrushTip& tip) {
    tip_ = tip;
    if (core_.form()) vesselbench::set_tip(*core_.form(), tip);
}

void BrushFeature::begin_stroke(StrokeKeys keys) {
    if (can_paint())
        core_.document.begin_stroke(stroke_of(*core_.form(), tip(), keys), core_.step());
}

/// An edit's own tip stays.
void BrushFeature::form_shown() {
    if (has_brush() && !core_.form()->edit() && tip_.radius > 0.0)
        vesselbench::set_tip(*core_.form(), tip_);
}

void BrushFeature::field_changed() {
    if (has_brush()) tip_ = tip();
}

}  // namespace vesselbench
