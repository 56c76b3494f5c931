#include "workbench/window/panels/leaving_dialog.h"

#include <utility>

#include <imgui.h>

#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

void leave_now(Core& core, Shown& shown) {
    const Leaving what = std::exchange(shown.leaving, Leaving::Nothing);
    if (what == Leaving::Window) shown.closes = true;
    if (what == Leaving::Case) core.close();
}

void draw_buttons(PanelContext& c) {
    const float width = c.ui.em * 11;
    // At the lower end: what runs changes the length of the text above.
    ImGui::SetCursorPos({ImGui::GetWindowWidth() - c.ui.grid(2.5F) - 2 * width - c.ui.grid(1),
                         ImGui::GetWindowHeight() - c.ui.grid(2.5F) - ImGui::GetFrameHeight()});
    const bool stays =
        button(c.ui, "leaving.stay", "Let it run", {.primary = true, .width = width});
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "leaving.leave", "Cancel it and close", {.width = width}))
        return leave_now(c.core, c.shown);
    if (stays) c.shown.leaving = Leaving::Nothing;
}

}  // namespace

void leave(Core& core, Shown& shown, Leaving what) {
    shown.leaving = what;
    if (!core.document.is_editing()) leave_now(core, shown);
}

void draw_leaving_dialog(PanelContext& c, const ScreenRect& window) {
    if (c.shown.leaving == Leaving::Nothing) return;
    if (!c.place.document.is_editing()) return void(c.shown.leaving = Leaving::Nothing);
    const Ui& ui = c.ui;
    begin_dialog(ui, "leaving", window, ui.em * 32, ui.em * 12);
    heading(ui, "An edit is running");
    const auto activity = c.place.document.activity();
    wrapped(ui,
            (activity ? activity->what + ". " : "") +
                "Closing cancels it; the edits that are made are kept.",
            ui.theme.muted, false);
    draw_buttons(c);
    end_frame();
}

}  // namespace vesselbench
