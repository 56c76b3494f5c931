#include "workbench/window/panels/unit_banner.h"

#include <imgui.h>

#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

void draw_answers(PanelContext& c, const UnitQuestion& question) {
    const bool can_answer = c.place.document.can(RequestKind::Edit);
    for (const char* unit : {"mm", "cm", "m"}) {
        const bool taken = question.read == unit;
        if (button(c.ui, "banner.unit." + std::string(unit), "It is in " + std::string(unit),
                   {.primary = taken,
                    .enabled = can_answer,
                    .help = taken ? "The size is right as it is shown"
                                  : "Reads the file again; later edits become pending"}))
            return c.place.answer_unit(unit);
        ImGui::SameLine(0, c.ui.grid(1));
    }
}

}  // namespace

float draw_unit_banner(PanelContext& c, const ScreenRect& place) {
    const Ui& ui = c.ui;
    const UnitQuestion question = *c.place.unit_question();
    const std::string words = question.doubt + ". It is shown as " + question.read + ".";
    const float left = ui.em * 2, room = place.width - left - ui.grid(2);
    const std::string lines = broken(words, room);
    const float text_height = ImGui::CalcTextSize(lines.c_str(), nullptr, false, room).y;
    const float height = text_height + ImGui::GetFrameHeight() + ui.grid(4);
    begin_frame(ui, "banner.unit", {place.x, place.y, place.width, height},
                {.back = ui.theme.raised,
                 .padding = ui.grid(1),
                 .scrolls = false,
                 .floats = true,
                 .bordered = true});
    text(ui, icons::kWarning, ui.theme.warning);
    ImGui::SameLine(left);
    text(ui, lines, ui.theme.text);
    ImGui::SetCursorPos({left, text_height + ui.grid(2.5F)});
    draw_answers(c, question);
    end_frame();
    return height;
}

}  // namespace vesselbench
