#include "workbench/window/panels/bottom_panel.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/core/shown.h"
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

void draw_tab(PanelContext& c, const std::string& name, const char* icon, const std::string& label,
              BottomTab tab) {
    const bool chosen = c.shown.bottom == tab;
    ImGui::PushFont(chosen ? c.ui.fonts.medium : c.ui.fonts.regular);
    if (button(c.ui, name, label, {.icon = icon, .quiet = true})) c.shown.bottom = tab;
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

}  // namespace

void draw_bottom_panel(PanelContext& c, const ScreenRect& rect) {
    begin_frame(c.ui, "bottom", rect, {.padding = c.ui.grid(0.5F), .scrolls = false});
    draw_tab(c, "tab.history", icons::kHistory, "History", BottomTab::History);
    ImGui::SameLine();
    draw_tab(c, "tab.messages", icons::kMessages, message_label(c.place.document),
             BottomTab::Messages);
    ImGui::SameLine();
    draw_tab(c, "tab.measures", icons::kRuler, measure_label(c.place.measures()),
             BottomTab::Measures);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - c.ui.grid(0.5F));
    separator(c.ui);
    ImGui::BeginChild("bottom content");
    if (c.shown.bottom == BottomTab::History) draw_history(c);
    if (c.shown.bottom == BottomTab::Messages) draw_messages(c);
    if (c.shown.bottom == BottomTab::Measures) draw_measure_table(c);
    ImGui::EndChild();
    end_frame();
}

}  // namespace vesselbench
