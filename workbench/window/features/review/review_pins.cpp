#include "workbench/window/features/review/review_pins.h"

#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_words.h"

namespace vesselbench {

namespace {

void draw_pins(PanelContext& c, const PixelView& screen, const ReviewedEdit& edit, bool named) {
    for (std::size_t i = 0; i < edit.pins.size(); ++i) {
        const auto at = screen.place(edit.pins[i].pin.place);
        if (!at) continue;
        draw_mark(c.ui, *at, named ? MarkLook::Picked : MarkLook::Offered,
                  named ? pin_words(edit.pins[i]) : "");
        c.ui.item("view.pin." + std::to_string(edit.edit.id) + "." + std::to_string(i),
                  spot_rect(*at));
    }
}

}  // namespace

void draw_review_pins(PanelContext& c, const PixelView& screen) {
    const ReviewFeature& feature = c.core.get<ReviewFeature>();
    if (!feature.is_shown() || !feature.review()) return;
    const ReviewedEdit* chosen = feature.chosen();
    for (const ReviewedEdit& edit : feature.review()->edits)
        draw_pins(c, screen, edit, chosen == nullptr || chosen == &edit);
}

}  // namespace vesselbench
