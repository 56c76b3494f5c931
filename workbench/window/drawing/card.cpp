#include "workbench/window/drawing/card.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/drawing/view_overlays.h"

namespace vesselbench {

namespace {

constexpr float kBeside = 1.5F;      ///< distance from the place [em]
constexpr float kAbove = 3.0F;       ///< the same above or below it, where its marks are [em]
constexpr float kBelowTools = 4.0F;  ///< a card leaves this of the view's top to its tools [em]

/// Where a card is beside a place, as a corner; where neither side has room, above or below it.
ImVec2 corner_beside(const Ui& ui, const ScreenRect& room, const ScreenRect& card,
                     const ViewPixel& at) {
    const auto x = static_cast<float>(at.x()), y = static_cast<float>(at.y());
    const float right = x + kBeside * ui.em, left = x - kBeside * ui.em - card.width;
    const float middle = y - card.height / 2;
    if (right + card.width <= room.x + room.width) return {right, middle};
    if (left >= room.x) return {left, middle};
    const float above = y - kAbove * ui.em - card.height;
    return {x - card.width / 2, above >= room.y ? above : y + kAbove * ui.em};
}

/// The view's part for cards: below its tools, above the orientation.
ScreenRect room_of(const Ui& ui, const ScreenRect& view) {
    const float pad = ui.grid(1), top = view.y + kBelowTools * ui.em;
    return {view.x + pad, top, view.width - 2 * pad,
            std::max(orientation_rect(ui, view).y - pad - top, 1.0F)};
}

}  // namespace

ScreenRect draw_card(const Ui& ui, const ScreenRect& view, const ViewPixel& at, float width,
                     int lines) {
    const float pad = ui.grid(1), count = static_cast<float>(lines);
    ScreenRect card{.width = width * ui.em,
                    .height = count * ImGui::GetFrameHeight() + (count + 1) * pad};
    const ScreenRect room = room_of(ui, view);
    const ImVec2 corner = corner_beside(ui, room, card, at);
    card.x = std::clamp(corner.x, room.x, std::max(room.x, room.x + room.width - card.width));
    card.y = std::clamp(corner.y, room.y, std::max(room.y, room.y + room.height - card.height));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding;
    const ImVec2 from{card.x, card.y}, to{card.x + card.width, card.y + card.height};
    draw.AddRectFilled(from, to, faded(ui.theme.panel, 0.96), rounding);
    draw.AddRect(from, to, ui.theme.border, rounding);
    ImGui::SetCursorScreenPos({card.x + pad, card.y + pad});
    return card;
}

}  // namespace vesselbench
