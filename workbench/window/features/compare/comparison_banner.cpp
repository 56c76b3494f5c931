#include "workbench/window/features/compare/comparison_banner.h"

#include <imgui.h>

#include "workbench/report/log_json.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

struct ModeLook {
    CompareMode mode;
    const char* item;
    const char* label;
    const char* help;
};

constexpr ModeLook kModes[] = {
    {CompareMode::SideBySide, "compare.side", "Side by side", "Both, seen from the same direction"},
    {CompareMode::Blink, "compare.blink", "Blink",
     "Alternates the two in place; Space switches manually."},
    {CompareMode::Deviation, "compare.deviation", "Deviation",
     "The shown surface, coloured by its distance from the reference"}};

/// By how much the shown surface differs.
std::string difference_text(const Comparison& comparison) {
    if (!comparison.problem().empty()) return comparison.problem();
    if (!comparison.difference()) return "measuring the difference";
    const std::string change = change_text(comparison.difference()->change);
    return change.empty() ? "the surfaces are the same" : change;
}

void draw_mode(PanelContext& c, Comparison& comparison, const ModeLook& look) {
    const bool chosen = comparison.mode() == look.mode;
    ImGui::PushFont(chosen ? c.ui.fonts.medium : c.ui.fonts.regular);
    if (button(c.ui, look.item, look.label, {.quiet = true, .help = look.help}))
        comparison.set_mode(look.mode);
    ImGui::PopFont();
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    if (chosen)
        ImGui::GetWindowDrawList()->AddRectFilled({from.x, to.y - c.ui.grid(0.25F)}, to,
                                                  c.ui.theme.accent);
    ImGui::SameLine(0, c.ui.grid(0.5F));
}

}  // namespace

float comparison_banner_height(const Ui& ui) {
    return ImGui::GetFrameHeight() + ui.grid(1.5F);
}

bool draw_comparison_banner(PanelContext& c, Comparison& comparison, const ScreenRect& rect) {
    const Ui& ui = c.ui;
    begin_frame(ui, "banner.comparison", rect,
                {.back = ui.theme.raised,
                 .padding = ui.grid(0.75F),
                 .scrolls = false,
                 .floats = true,
                 .bordered = true});
    for (const ModeLook& look : kModes) draw_mode(c, comparison, look);
    const float side = ImGui::GetFrameHeight();
    const float end = rect.width - ui.grid(0.75F) - side;
    ImGui::SameLine(0, ui.grid(1));
    ImGui::AlignTextToFramePadding();
    clipped_text(ui, difference_text(comparison), ui.theme.muted,
                 end - ImGui::GetCursorPosX() - ui.grid(1));
    ImGui::SameLine();
    ImGui::SetCursorPos({end, ui.grid(0.75F)});
    const bool ended = icon_button(c.ui, "compare.close", icons::kClose, "End the comparison  Esc");
    end_frame();
    return ended;
}

}  // namespace vesselbench
