#include "workbench/window/panels/bottom_panel.h"

#include <algorithm>
#include <array>
#include <string>

#include <imgui.h>

#include "workbench/window/core/shown.h"
#include "workbench/window/features/findings/findings_feature.h"
#include "workbench/window/features/findings/findings_panel.h"
#include "workbench/window/features/history/history_panel.h"
#include "workbench/window/features/measures/measure_panel.h"
#include "workbench/window/panels/message_panel.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

struct Tab {
    const char* name;
    const char* icon;
    std::string label;
    BottomTab tab;
};

/// \param named with its label, else as an icon
void draw_tab(PanelContext& c, const Tab& tab, bool named) {
    const bool chosen = c.shown.bottom == tab.tab;
    ImGui::PushFont(chosen ? c.ui.fonts.medium : c.ui.fonts.regular);
    const bool clicked = named
                             ? button(c.ui, tab.name, tab.label, {.icon = tab.icon, .quiet = true})
                             : icon_button(c.ui, tab.name, tab.icon, tab.label);
    if (clicked) c.shown.bottom = tab.tab;
    ImGui::PopFont();
    if (!chosen) return;
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled({from.x, to.y}, {to.x, to.y + c.ui.grid(0.25F)},
                                              c.ui.theme.accent);
}

std::string message_label(const Document& document) {
    const auto& all = document.messages();
    const auto serious = std::ranges::count_if(all, [](const Message& message) {
        return message.kind == MessageKind::Warning || message.kind == MessageKind::Error;
    });
    return serious == 0 ? "Messages" : "Messages (" + std::to_string(serious) + ")";
}

std::string measure_label(const MeasureList& measures) {
    const std::size_t count = measures.all().size();
    return count == 0 ? "Measurements" : "Measurements (" + std::to_string(count) + ")";
}

std::string finding_label(const FindingsFeature& feature) {
    const std::size_t count = feature.listed();
    return count == 0 ? "Findings" : "Findings (" + std::to_string(count) + ")";
}

void draw_tabs(PanelContext& c) {
    const std::array<Tab, 4> tabs = {
        {{"tab.history", icons::kHistory, "History", BottomTab::History},
         {"tab.messages", icons::kMessages, message_label(c.place.document), BottomTab::Messages},
         {"tab.measures", icons::kRuler, measure_label(c.place.measures()), BottomTab::Measures},
         {"tab.findings", icons::kTarget, finding_label(c.core.get<FindingsFeature>()),
          BottomTab::Findings}}};
    float wide = 0;
    for (const Tab& tab : tabs) wide += ImGui::CalcTextSize(tab.label.c_str()).x + c.ui.em * 3.2F;
    const bool room = wide < ImGui::GetContentRegionAvail().x;
    for (const Tab& tab : tabs) {
        draw_tab(c, tab, room || c.shown.bottom == tab.tab);
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

}  // namespace

void draw_bottom_panel(PanelContext& c, const ScreenRect& rect) {
    begin_frame(c.ui, "bottom", rect, {.padding = c.ui.grid(0.5F), .scrolls = false});
    draw_tabs(c);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - c.ui.grid(0.5F));
    separator(c.ui);
    ImGui::BeginChild("bottom content");
    if (c.shown.bottom == BottomTab::History) draw_history(c);
    if (c.shown.bottom == BottomTab::Messages) draw_messages(c);
    if (c.shown.bottom == BottomTab::Measures) draw_measure_table(c);
    if (c.shown.bottom == BottomTab::Findings) draw_findings(c);
    ImGui::EndChild();
    end_frame();
}

}  // namespace vesselbench
