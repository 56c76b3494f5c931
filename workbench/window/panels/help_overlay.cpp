#include "workbench/window/panels/help_overlay.h"

#include <imgui.h>

#include "workbench/window/case/handbook.h"
#include "workbench/window/case/message.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/keys/key_table.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

void draw_keys(const Ui& ui, const std::string& title, KeyGroup group) {
    group_heading(ui, title);
    space(ui, 1);
    for (const KeyRow& row : key_table()) {
        if (row.group != group) continue;
        text(ui, keys_text(row), ui.theme.text);
        ImGui::SameLine(ui.em * 12);  // from the group's left
        text(ui, row.meaning, ui.theme.muted);
    }
}

/// True for a click beside the help.
bool clicked_outside(const ScreenRect& rect) {
    return ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
           !ImGui::IsMouseHoveringRect({rect.x, rect.y},
                                       {rect.x + rect.width, rect.y + rect.height}, false);
}

constexpr const char* kFirstSteps =
    "1. Open an image or a surface, or a bundled case. A project file is made for it.\n"
    "2. Press Prepare to run a complete recipe; or go through the steps on the left, one by one.\n"
    "3. Choose a step, then an operation on the right. Preview shows its result, Apply adds the "
    "edit.\n"
    "4. Click an edit in the steps to change it; click a state of the history to go there.\n"
    "5. Export writes the model. There is nothing to save: each edit is in the project file.";

/// Leads to all pages, in the browser.
void draw_handbook_button(PanelContext& c) {
    static const std::filesystem::path page = handbook_page();
    if (page.empty() || !button(c.ui, "help.docs", "Open the handbook in the browser")) return;
    if (!show_handbook(page, ""))
        c.place.document.tell(make_message(
            MessageKind::Remark, "No browser is found; the handbook is " + page.string()));
}

}  // namespace

void draw_help_overlay(PanelContext& c, const ScreenRect& window) {
    const Ui& ui = c.ui;
    const ScreenRect rect = begin_dialog(ui, "help", window, ui.em * 56, ui.em * 56);
    heading(ui, "Help");
    ImGui::SameLine(rect.width - ui.grid(2.5F) - ImGui::GetFrameHeight());
    const bool closed = icon_button(c.ui, "help.close", icons::kClose, "Close  Esc");
    if (closed || clicked_outside(rect)) c.shown.help = false;
    space(ui, 1);
    ImGui::BeginChild("help text");
    wrapped(ui, kFirstSteps, ui.theme.text, false);
    space(ui, 1);
    draw_handbook_button(c);
    space(ui, 3);
    const float half = ImGui::GetContentRegionAvail().x / 2;
    ImGui::BeginGroup();
    draw_keys(ui, "Editing", KeyGroup::Editing);
    space(ui, 2);
    draw_keys(ui, "Brushes", KeyGroup::Brushes);
    space(ui, 2);
    draw_keys(ui, "Slices", KeyGroup::Slices);
    ImGui::EndGroup();
    ImGui::SameLine(half);
    ImGui::BeginGroup();
    draw_keys(ui, "View", KeyGroup::View);
    space(ui, 2);
    draw_keys(ui, "View modes", KeyGroup::Modes);
    space(ui, 2);
    draw_keys(ui, "In the step Review", KeyGroup::Review);
    ImGui::EndGroup();
    ImGui::EndChild();
    end_frame();
}

}  // namespace vesselbench
