#include "workbench/window/drawing/view_strips.h"

#include <algorithm>

#include <imgui.h>

namespace vesselbench {

namespace {

constexpr float kFree = 2.8F;  ///< below the lowest plate, for hints and the scale bar [em]

}  // namespace

float ViewStrips::begin(const Ui& ui, const std::string& name, float width) {
    const float pad = ui.grid(0.5F), high = ImGui::GetFrameHeight() + 2 * pad;
    const float wide = std::min(width, view_.width - 2 * ui.grid(1.5F) - 2 * pad);
    const float left = view_.middle_x() - wide / 2;
    const float top = view_.y + view_.height - ui.em * kFree - high - above_;
    const ImVec2 from{left - pad, top}, to{left + wide + pad, top + high};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding;
    draw.AddRectFilled(from, to, faded(ui.theme.panel, 0.94), rounding);
    draw.AddRect(from, to, ui.theme.border, rounding);
    // Takes the mouse from the view behind it.
    ImGui::SetCursorScreenPos(from);
    ImGui::InvisibleButton(("strip." + name).c_str(), {to.x - from.x, to.y - from.y});
    ImGui::SetItemAllowOverlap();
    ImGui::SetCursorScreenPos({left, top + pad});
    above_ += high + ui.grid(0.75F);
    return wide;
}

void ViewStrips::next(const Ui& ui) {
    ImGui::SameLine(0, ui.grid(0.75F));
}

}  // namespace vesselbench
