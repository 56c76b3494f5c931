#include "workbench/window/features/history/note_dialog.h"

#include <utility>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

void save(PanelContext& c) {
    const NoteInProgress note = *std::exchange(c.shown.note, std::nullopt);
    c.core.document.set_note(note.edit, note.words);
}

void draw_words(PanelContext& c, float height) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::InputTextMultiline("##note", &c.shown.note->words, {-1, height});
    c.ui.item("note.words");
}

void draw_buttons(PanelContext& c) {
    const Document& document = c.core.document;
    const float width = c.ui.em * 8;
    const bool can_save = document.can(RequestKind::History);
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - c.ui.grid(2.5F) - 2 * width - c.ui.grid(1));
    const bool cancels = button(c.ui, "note.cancel", "Cancel", {.width = width});
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "note.save", "Save", {.primary = true, .enabled = can_save, .width = width}))
        save(c);
    else if (cancels)
        c.shown.note.reset();
}

}  // namespace

void draw_note_dialog(PanelContext& c, const ScreenRect& window) {
    const Ui& ui = c.ui;
    begin_dialog(ui, "note", window, ui.em * 32, ui.em * 17);
    heading(ui, "Note on " + c.shown.note->title);
    wrapped(ui, "Stored with the edit in the project's log; the model does not change.",
            ui.theme.muted);
    space(ui, 1);
    draw_words(c, ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeight() - ui.grid(2));
    space(ui, 1);
    draw_buttons(c);
    end_frame();
}

}  // namespace vesselbench
