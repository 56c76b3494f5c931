#include "workbench/window/features/borders/borders.h"

#include <algorithm>
#include <string>

#include <imgui.h>

#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"

namespace vesselbench {

namespace {

constexpr float kGrip = 3.0F;         ///< length of what is seen of a border [em]
constexpr float kStill = 3.0F;        ///< a shorter drag is a click [pixels]
constexpr double kFoldsBelow = 0.04;  ///< a smaller share [-]

std::string name_of(Panel panel) {
    return std::ranges::find(kPanels, panel, &std::pair<const char*, Panel>::second)->first;
}

std::string help_of(Panel panel, bool folded) {
    switch (panel) {
        case Panel::Rail:
            return folded ? "Show the steps" : "Drag to resize, click to fold the steps";
        case Panel::Operation:
            return folded ? "Show the operations" : "Drag to resize, click to fold the operations";
        case Panel::Bottom:
            return folded ? "Show the history" : "Drag to resize, click to fold the history";
        case Panel::Slices:
            return "Drag to resize, double click for the usual size";
    }
    return "";
}

void drag(PanelContext& c, const Border& border) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float at = border.upright ? mouse.x : mouse.y;
    const double share =
        std::clamp(static_cast<double>((at - border.from) / (border.to - border.from)), 0.0, 1.0);
    PanelSize& size = c.core.settings.panels[border.panel];
    size.folded = border.panel != Panel::Slices && share < kFoldsBelow;
    if (!size.folded) size.share = share;
    if (border.panel == Panel::Bottom) c.shown.enlarged = Enlarged::None;
}

void click(PanelContext& c, const Border& border) {
    PanelSize& size = c.core.settings.panels[border.panel];
    if (border.panel == Panel::Bottom && c.shown.enlarged != Enlarged::None)
        c.shown.enlarged = Enlarged::None;
    else if (border.panel != Panel::Slices)
        size.folded = !size.folded;
    else if (ImGui::GetIO().MouseClickedLastCount[ImGuiMouseButton_Left] > 1)
        size.share.reset();
}

void draw_grip(const Ui& ui, const Border& border, bool lit) {
    const ScreenRect& r = border.rect;
    const float length = std::min(kGrip * ui.em, border.upright ? r.height : r.width) / 2;
    const ImVec2 half = border.upright ? ImVec2(1, length) : ImVec2(length, 1);
    const ImVec2 middle(r.middle_x(), r.y + r.height / 2);
    ImGui::GetWindowDrawList()->AddRectFilled({middle.x - half.x, middle.y - half.y},
                                              {middle.x + half.x, middle.y + half.y},
                                              lit ? ui.theme.accent : ui.theme.muted);
}

}  // namespace

void draw_border(PanelContext& c, const Border& border) {
    const std::string name = "border." + name_of(border.panel);
    const bool folded = c.core.settings.panels[border.panel].folded;
    begin_frame(c.ui, name, border.rect,
                {.back = c.ui.theme.border, .padding = 0, .scrolls = false});
    ImGui::InvisibleButton(name.c_str(), {border.rect.width, border.rect.height});
    c.ui.item(name);
    const bool active = ImGui::IsItemActive(), over = ImGui::IsItemHovered();
    const bool still =
        ImGui::GetIO().MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < kStill * kStill;
    if (active && !still) drag(c, border);
    if (ImGui::IsItemDeactivated() && still && over) click(c, border);
    if (ImGui::IsItemDeactivated()) c.core.settings.save_soon();
    if (over || active)
        ImGui::SetMouseCursor(border.upright ? ImGuiMouseCursor_ResizeEW
                                             : ImGuiMouseCursor_ResizeNS);
    if (over && !active) help_on_hover(c.ui, help_of(border.panel, folded));
    draw_grip(c.ui, border, over || active || folded);
    end_frame();
}

}  // namespace vesselbench
