#include "workbench/window/view/card.h"

#include <algorithm>

#include <imgui.h>

namespace vesselbench {

namespace {

constexpr float kBeside = 1.5F;      ///< distance from the place [em]
constexpr float kBelowTools = 4.0F;  ///< a card leaves this of the view's top to its tools [em]

}  // namespace

ScreenRect draw_card(const Ui& ui, const ScreenRect& view, const ViewPixel& at, float width,
                     int lines) {
    const float pad = ui.grid(1), count = static_cast<float>(lines);
    ScreenRect card{.width = width * ui.em,
                    .height = count * ImGui::GetFrameHeight() + (count + 1) * pad};
    const float most_x = view.x + view.width - card.width - pad;
    const float most_y = view.y + view.height - card.height - pad;
    const float right = static_cast<float>(at.x()) + kBeside * ui.em;
    const float left = static_cast<float>(at.x()) - kBeside * ui.em - card.width;
    const float x = right > most_x && left >= view.x + pad ? left : right;
    const float y = static_cast<float>(at.y()) - card.height / 2;
    const float top = view.y + kBelowTools * ui.em;
    card.x = std::clamp(x, view.x + pad, std::max(view.x + pad, most_x));
    card.y = std::clamp(y, top, std::max(top, most_y));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding;
    const ImVec2 from{card.x, card.y}, to{card.x + card.width, card.y + card.height};
    draw.AddRectFilled(from, to, faded(ui.theme.panel, 0.96), rounding);
    draw.AddRect(from, to, ui.theme.border, rounding);
    ImGui::SetCursorScreenPos({card.x + pad, card.y + pad});
    return card;
}

}  // namespace vesselbench
