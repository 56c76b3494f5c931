#include "workbench/window/features/review/review_layout.h"

#include <imgui.h>

#include "workbench/window/widgets/controls.h"

namespace vesselbench {

void review_line(PanelContext& c, const std::string& words, Paint colour) {
    ImGui::SetCursorPosX(c.ui.grid(2));
    wrapped(c.ui, words, colour);
}

float begin_review_controls(PanelContext& c, int count) {
    ImGui::SetCursorPosX(c.ui.grid(2));
    const float gaps = c.ui.grid(1) * static_cast<float>(count - 1);
    return (ImGui::GetContentRegionAvail().x - c.ui.grid(2) - gaps) / static_cast<float>(count);
}

void next_review_control(PanelContext& c) {
    ImGui::SameLine(0, c.ui.grid(1));
}

}  // namespace vesselbench
