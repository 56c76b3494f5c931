#include "workbench/window/features/review/review_clicks.h"

#include <imgui.h>

#include "workbench/window/core/core.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

void ReviewClicks::update(PanelContext& c, const SeenModel& seen) {
    const int scenes = c.core.document.scene_changes();
    if (tool_ != c.core.view.tool || seen_scenes_ != scenes) forget();
    tool_ = c.core.view.tool;
    seen_scenes_ = scenes;
    const bool takes = c.core.has_click_tool() && is_reviewing(tool_);
    if (takes && seen.surface != nullptr && seen.clicked) clicks_.add(seen);
    if (const auto place = clicks_.update()) c.core.get<ReviewFeature>().mark(*place);
}

void ReviewClicks::draw_strip(PanelContext& c, ViewStrips& strips) const {
    if (!is_reviewing(c.core.view.tool)) return;
    const Ui& ui = c.ui;
    const bool pins = c.core.view.tool == ClickTool::ReviewPin;
    const bool begun = c.core.get<ReviewFeature>().first_point().has_value();
    const float side = ImGui::GetFrameHeight(), gap = ui.grid(0.75F);
    const float wide = strips.begin(ui, "review", ui.em * 22);
    const float left = ImGui::GetCursorPosX();
    ImGui::SetCursorPosX(left + gap);
    ImGui::AlignTextToFramePadding();
    clipped_text(ui,
                 pins    ? "Pin: click a place on the surface"
                 : begun ? "Distance: click its other end"
                         : "Distance: click its first end",
                 ui.theme.text, wide - side - 3 * gap);
    ImGui::SameLine(left + wide - side);
    if (icon_button(c.ui, "review.stop", icons::kClose, "Stop placing  Esc"))
        c.core.view.tool = ClickTool::None;
}

}  // namespace vesselbench
