#include "workbench/window/features/extraction/extraction_banner.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/banner.h"

namespace vesselbench {

namespace {

std::string extraction_text(const LiveExtraction& extraction) {
    if (!extraction.problem().empty()) return readable_sentence(extraction.problem());
    if (!extraction.shown()) return "Extracting the surface";
    return extraction.outdated() ? "Live preview, coarse" : "Live preview, not applied yet";
}

}  // namespace

// No wider than its words: the slices leave the view little height, and the vessel is seen beside
// it.
float draw_extraction_banner(PanelContext& c, LiveExtraction& extraction, const ScreenRect& place) {
    const bool failed = !extraction.problem().empty();
    const Banner banner{failed ? icons::kWarning : icons::kPreview,
                        failed ? c.ui.theme.warning : c.ui.theme.accent,
                        extraction_text(extraction), "", true};
    const float wide = ImGui::CalcTextSize(banner.text.c_str()).x + c.ui.em * 7;
    const float spare = std::max(place.width - wide, 0.0F);
    ScreenRect rect{place.x + spare, place.y, place.width - spare, 0};
    rect.height = height_of(c.ui, banner, rect.width);
    c.ui.item("banner.live", rect);
    if (draw_banner(c.ui, "live", banner, rect) == BannerAnswer::Close) extraction.follow(false);
    return rect.height;
}

}  // namespace vesselbench
