#include "workbench/window/panels/shortcuts.h"

#include <imgui.h>

#include "workbench/window/keys.h"
#include "workbench/window/panels/view_panel.h"

namespace vesselbench {

namespace {

bool pressed(int key) {
    return ImGui::IsKeyPressed(key, false);
}

void handle_escape(PanelContext& c) {
    if (c.shown.help || c.shown.prepare || c.shown.note) {
        c.shown.help = c.shown.prepare = false;
        c.shown.note.reset();
    } else if (c.place.question() != FileQuestion::None) {
        c.place.ask(FileQuestion::None);
    } else if (c.place.document.is_painting()) {
        c.place.document.drop_stroke();
    } else if (c.place.before_drag()) {
        c.place.cancel_drag();
    } else if (c.place.role_question()) {
        c.place.forget_role_question();
    } else if (!c.place.armed().empty()) {
        c.place.disarm();
    } else if (leave_view_mode(c)) {
        return;
    } else if (c.place.document.activity()) {
        c.place.document.cancel();
    } else if (c.place.comparison() && !ImGui::GetIO().WantTextInput) {
        c.place.stop_comparing();
    } else if (!ImGui::GetIO().WantTextInput) {
        c.place.leave_form();
    }
}

void handle_history(PanelContext& c) {
    if (!c.place.document.can(RequestKind::History)) return;
    const bool redo = ImGui::GetIO().KeyShift;
    const HistoryTree& history = c.place.history();
    if (pressed(keys::letter('Z')) && !redo && history.can_undo) c.place.document.undo();
    if (((pressed(keys::letter('Z')) && redo) || pressed(keys::letter('Y'))) && history.can_redo)
        c.place.document.redo();
}

void handle_control(PanelContext& c) {
    const bool writes = c.place.document.can(RequestKind::Output);
    if (!ImGui::GetIO().WantTextInput) handle_history(c);
    if (pressed(keys::letter('O'))) c.place.ask(FileQuestion::Open);
    if (pressed(keys::letter('S')) && writes) c.place.ask(FileQuestion::SaveCopy);
    if (pressed(keys::letter('E')) && writes) c.place.ask(FileQuestion::Export);
    if (pressed(keys::letter('P'))) c.place.preview();
    if (pressed(keys::kEnter)) c.place.apply();
}

/// The image: its slices, or its planes in the 3D view.
void handle_image(PanelContext& c) {
    ImageSlices& slices = c.place.slices();
    if (!slices.has_image() || !pressed(keys::letter('I'))) return;
    if (ImGui::GetIO().KeyShift)
        slices.show_in_space(!slices.any_in_space());
    else
        slices.show_row(!slices.in_row());
}

}  // namespace

void handle_shortcuts(PanelContext& c) {
    if (pressed(keys::kF1)) c.shown.help = !c.shown.help;
    if (pressed(keys::kEscape)) handle_escape(c);
    const bool dialog =
        c.shown.help || c.shown.prepare || c.shown.note || c.place.question() != FileQuestion::None;
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl && !dialog) handle_control(c);
    if (io.KeyCtrl || dialog || io.WantTextInput) return;
    handle_image(c);
    handle_view_keys(c);
}

}  // namespace vesselbench
