#pragma once

#include "workbench/window/case/stroke.h"
#include "workbench/window/case/stroke_request.h"
#include "workbench/window/core/core.h"

namespace vesselbench {

/// Painting on the model by the form of a brush.
class BrushFeature : public Feature {
public:
    explicit BrushFeature(Core& core) : core_(core) {}

    /// True if the form is of a brush that can paint on the shown surface now; not while clicks
    /// are for a parameter.
    [[nodiscard]] bool can_paint() const;

    /// True while a stroke of the form's brush is drawn.
    [[nodiscard]] bool is_painting() const;

    /// The form's brush, which later forms of brushes take over.
    [[nodiscard]] BrushTip tip() const;
    void set_tip(const BrushTip& tip);

    void begin_stroke(StrokeKeys keys);

    void form_shown() override;
    void field_changed() override;

private:
    [[nodiscard]] bool has_brush() const;

    Core& core_;
    BrushTip tip_;  ///< of the last form of a brush
};

}  // namespace vesselbench
