#include "workbench/window/features/live/live_banner.h"

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/banner.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

constexpr float kNarrow = 26.0F;  ///< a narrower banner has no figures [em]

std::string figures_of(const LiveModel& model) {
    const auto& change = model.state.change;
    if (!change) return "";
    return "Vertices are displaced from the previous surface by " + formatted(change->error.mean) +
           " mm on average, at most " + formatted(change->error.largest) + " mm; volume " +
           formatted(change->volume_change_percent, "%+.2f %%") + "; normal curvature " +
           formatted(change->normal_curvature_before_deg) + " to " +
           formatted(change->normal_curvature_after_deg) + " deg";
}

/// What is shown is not all of what is asked for.
std::string progress_of(const LiveModel& model) {
    const auto& state = model.state;
    if (state.whole) return "";
    return "Coarse: " + std::to_string(state.iterations) + " of " +
           std::to_string(state.resolved.integer("iterations")) + " iterations";
}

std::string live_text(const LiveSmoothing& live) {
    const auto& model = live.shown();
    if (!live.problem().empty()) return readable_sentence(live.problem());
    if (!model) return "Finding what the smoothing depends on";
    std::string text = "Live preview, not applied yet";
    for (const std::string& more : {progress_of(*model), figures_of(*model)})
        if (!more.empty()) text += ". " + more;
    return text;
}

}  // namespace

// Its figures would cover a narrow view: the pointer shows them there.
float draw_live_banner(PanelContext& c, LiveSmoothing& live, const ScreenRect& place) {
    const bool failed = !live.problem().empty(), narrow = place.width < c.ui.em * kNarrow;
    const std::string all = live_text(live);
    const Banner banner{failed ? icons::kWarning : icons::kPreview,
                        failed ? c.ui.theme.warning : c.ui.theme.accent,
                        narrow && !failed ? all.substr(0, all.find(". ")) : all, "", true};
    ScreenRect rect = place;
    rect.height = height_of(c.ui, banner, rect.width);
    c.ui.item("banner.live", rect);
    if (narrow &&
        ImGui::IsMouseHoveringRect({rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height}))
        tooltip(c.ui, all);
    if (draw_banner(c.ui, "live", banner, rect) == BannerAnswer::Close) live.follow(false);
    return rect.height;
}

}  // namespace vesselbench
