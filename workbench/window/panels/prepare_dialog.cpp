#include "workbench/window/panels/prepare_dialog.h"

#include <imgui.h>

#include "workbench/case/argument_texts.h"
#include "workbench/case/purposes.h"
#include "workbench/window/model/readable.h"
#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/row.h"

namespace vesselbench {

namespace {

const char* icon_of(const Purpose& purpose) {
    if (purpose.simulates_flow) return icons::kWater;
    return purpose.name == "rp"         ? icons::kPrinter
           : purpose.name == "planning" ? icons::kImage
                                        : icons::kCube;
}

void draw_purposes(PanelContext& c) {
    for (const Purpose& purpose : purposes())
        if (row(c.ui, "prepare." + purpose.name,
                {.icon = icon_of(purpose),
                 .icon_colour = c.ui.theme.accent,
                 .title = purpose.title,
                 .detail = purpose.summary,
                 .selected = c.shown.purpose == purpose.name,
                 .strong = true}))
            c.shown.purpose = purpose.name;
}

void draw_entries(PanelContext& c) {
    group_heading(c.ui, "These edits will be made");
    space(c.ui, 0.5F);
    int number = 0;
    for (const RecipeEntry& entry : c.place.document.recipe(c.shown.purpose)) {
        const std::string arguments = argument_summary(entry.given.operation(), entry.given);
        text(c.ui, std::to_string(++number) + ".  " + readable(entry.given.operation().name),
             c.ui.theme.text);
        ImGui::SameLine();
        clipped_text(c.ui, arguments, c.ui.theme.muted,
                     ImGui::GetContentRegionAvail().x - c.ui.grid(1));
    }
}

void draw_buttons(PanelContext& c) {
    const float width = c.ui.em * 8;
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - c.ui.grid(2.5F) - 2 * width - c.ui.grid(1));
    if (button(c.ui, "prepare.cancel", "Cancel", {.width = width})) c.shown.prepare = false;
    ImGui::SameLine(0, c.ui.grid(1));
    if (!button(c.ui, "prepare.run", "Prepare", {.primary = true, .width = width})) return;
    c.place.leave_form();
    c.place.document.prepare(c.shown.purpose);
    c.shown.prepare = false;
}

}  // namespace

void draw_prepare_dialog(PanelContext& c, const ScreenRect& window) {
    const Ui& ui = c.ui;
    begin_dialog(ui, "prepare", window, ui.em * 52, ui.em * 29);
    heading(ui, "Prepare the model");
    wrapped(ui,
            "A recipe runs on the case as it is now. Each of its edits can be changed or undone "
            "afterwards.",
            ui.theme.muted, false);
    space(ui, 1.5F);
    const float height = ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeight() - ui.grid(2);
    ImGui::BeginChild("purposes", {ui.em * 20, height});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.grid(0.25F)});
    draw_purposes(c);
    ImGui::PopStyleVar();
    ImGui::EndChild();
    ImGui::SameLine(0, ui.grid(3));
    ImGui::BeginChild("entries", {0, height});
    draw_entries(c);
    ImGui::EndChild();
    space(ui, 1);
    draw_buttons(c);
    end_frame();
}

}  // namespace vesselbench
