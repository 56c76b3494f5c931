#include "workbench/window/panels/shortcuts.h"

#include <imgui.h>

#include "workbench/window/core/shown.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/keys/key_table.h"
#include "workbench/window/panels/view_panel.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

bool holds(Modifiers modifiers) {
    const bool control = ImGui::GetIO().KeyCtrl, shift = ImGui::GetIO().KeyShift;
    switch (modifiers) {
        case Modifiers::None:
            return !control && !shift;
        case Modifiers::Control:
            return control && !shift;
        case Modifiers::Shift:
            return !control && shift;
        case Modifiers::ControlShift:
            return control && shift;
        case Modifiers::Any:
            break;
    }
    return true;
}

bool is_pressed(const KeyBinding& binding) {
    if (!holds(binding.modifiers)) return false;
    if (binding.press == KeyPress::Held) return ImGui::IsKeyDown(binding.key);
    return ImGui::IsKeyPressed(binding.key, binding.press == KeyPress::Repeats);
}

bool has_dialog(const PanelContext& c) {
    return c.shown.help || c.shown.prepare || c.shown.note || c.shown.leaving != Leaving::Nothing ||
           c.place.question() != FileQuestion::None;
}

/// Dialogs and text fields keep the keys of the window from acting behind them.
KeyCommands pressed_keys(const PanelContext& c) {
    const KeyReach least = has_dialog(c)                  ? KeyReach::Everywhere
                           : ImGui::GetIO().WantTextInput ? KeyReach::TextFields
                                                          : KeyReach::Window;
    const KeyUse other = c.place.view.flies ? KeyUse::Outside : KeyUse::Flight;
    KeyCommands keys;
    for (const KeyRow& row : key_table()) {
        if (row.reach < least) continue;
        for (const KeyBinding& binding : row.bindings)
            if (binding.use != other && is_pressed(binding)) keys.add(binding.command);
    }
    return keys;
}

void handle_escape(PanelContext& c) {
    if (c.shown.leaving != Leaving::Nothing) {
        c.shown.leaving = Leaving::Nothing;
    } else if (c.shown.help || c.shown.prepare || c.shown.note) {
        c.shown.help = c.shown.prepare = false;
        c.shown.note.reset();
    } else if (c.place.question() != FileQuestion::None) {
        c.place.ask(FileQuestion::None);
    } else if (ImGui::GetIO().WantTextInput) {
        return;  // the field takes back its old text
    } else if (c.place.document.is_painting()) {
        c.place.document.drop_stroke();
    } else if (c.place.before_drag()) {
        c.place.cancel_drag();
    } else if (c.place.get<OpeningsFeature>().role_question()) {
        c.place.get<OpeningsFeature>().forget_role_question();
    } else if (!c.place.armed().empty()) {
        c.place.disarm();
    } else if (leave_view_mode(c)) {
        return;
    } else if (c.place.document.activity()) {
        c.place.document.cancel();
    } else if (c.place.get<GalleryFeature>().leave()) {
        return;
    } else if (c.place.comparison()) {
        c.place.get<CompareFeature>().stop();
    } else if (!c.place.take_back_drag()) {
        c.place.leave_form();
    }
}

void handle_files(PanelContext& c) {
    const KeyCommands& keys = c.shown.keys;
    const bool writes = c.place.document.can(RequestKind::Output);
    if (keys.has(KeyCommand::Open)) c.place.ask(FileQuestion::Open);
    if (keys.has(KeyCommand::SaveCopy) && writes) c.place.ask(FileQuestion::SaveCopy);
    if (keys.has(KeyCommand::Export) && writes) c.place.ask(FileQuestion::Export);
}

void handle_text_size(PanelContext& c) {
    Settings& settings = c.place.settings;
    const double before = settings.scale;
    if (c.shown.keys.has(KeyCommand::LargerText)) settings.change_scale(1);
    if (c.shown.keys.has(KeyCommand::SmallerText)) settings.change_scale(-1);
    if (c.shown.keys.has(KeyCommand::UsualText)) settings.scale = 1.0;
    if (settings.scale != before) settings.save_soon();
}

}  // namespace

void handle_shortcuts(PanelContext& c) {
    c.shown.keys = pressed_keys(c);
    const KeyCommands keys = c.shown.keys;
    if (keys.has(KeyCommand::Help)) c.shown.help = !c.shown.help;
    if (keys.has(KeyCommand::Cancel)) handle_escape(c);
    handle_text_size(c);
    handle_files(c);
    if (keys.has(KeyCommand::Preview)) c.place.preview();
    if (keys.has(KeyCommand::Apply)) c.place.apply_and_run();
    for (const auto& feature : c.place.features.all()) feature->keys(c);
    handle_view_keys(c);
}

}  // namespace vesselbench
