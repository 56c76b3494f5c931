#include "workbench/window/features/review/review_banner.h"

#include "workbench/window/core/core.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/banner.h"

namespace vesselbench {

float draw_review_banner(PanelContext& c, const ReviewedEdit& edit, const ScreenRect& place) {
    const Banner banner{icons::kNote, c.ui.theme.danger, "Rejected by " + remark_of(edit),
                        "Back to the review"};
    ScreenRect rect = place;
    rect.height = height_of(c.ui, banner, rect.width);
    if (draw_banner(c.ui, "review", banner, rect) == BannerAnswer::Action)
        c.core.choose_step(Step::Review);
    return rect.height;
}

}  // namespace vesselbench
