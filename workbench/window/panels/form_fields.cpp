#include "workbench/window/panels/form_fields.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/case/parameter_texts.h"
#include "workbench/window/model/readable.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

std::string item_name(const Parameter& parameter) {
    return "field." + parameter.name;
}

/// What an empty field says: nothing takes the place of a file that was not given.
std::string hint_of(const Parameter& parameter) {
    const bool file = parameter.type == ParameterType::File && !parameter.required;
    return file ? "none" : default_text(parameter);
}

void edit_text(PanelContext& c, const FormField& field, float width) {
    std::string text = field.text;
    if (text_field(
            c.ui, item_name(*field.parameter), text,
            {.hint = hint_of(*field.parameter), .wrong = !field.error.empty(), .width = width}))
        c.place.set_field(field.parameter->name, text);
}

void edit_file(PanelContext& c, const FormField& field) {
    const float side = ImGui::GetFrameHeight(), gap = c.ui.grid(0.5F);
    const std::string name = field.parameter->name;
    edit_text(c, field, ImGui::GetContentRegionAvail().x - side - gap);
    ImGui::SameLine(0, gap);
    if (icon_button(c.ui, item_name(*field.parameter) + ".browse", icons::kFolder, "Choose a file"))
        c.place.ask(FileQuestion::Parameter, name);
}

/// A place, with a button that lets it be picked in the view.
void edit_place(PanelContext& c, const FormField& field) {
    const float side = ImGui::GetFrameHeight(), gap = c.ui.grid(0.5F);
    const std::string name = field.parameter->name;
    edit_text(c, field, ImGui::GetContentRegionAvail().x - side - gap);
    ImGui::SameLine(0, gap);
    if (icon_button(c.ui, item_name(*field.parameter) + ".pick", icons::kTarget, "Pick in the view",
                    true, c.place.armed() == name))
        c.place.arm(name);
}

/// What a choice shows while nothing is given.
std::string unset_text(const Parameter& parameter) {
    return parameter.default_value ? to_text(*parameter.default_value) : default_text(parameter);
}

void edit_choice(PanelContext& c, const FormField& field) {
    const std::string unset = unset_text(*field.parameter);
    std::vector<std::string> options = field.parameter->choices;
    if (std::ranges::count(options, unset) == 0) options.insert(options.begin(), unset);
    std::string chosen = field.text.empty() ? unset : field.text;
    if (choice(c.ui, item_name(*field.parameter), options, chosen))
        c.place.set_field(field.parameter->name, chosen == unset ? "" : chosen);
}

void edit_flag(PanelContext& c, const FormField& field) {
    const std::string unset = unset_text(*field.parameter);
    bool on = (field.text.empty() ? unset : field.text) == "true";
    if (!checkbox(c.ui, item_name(*field.parameter), "", on)) return;
    const std::string text = on ? "true" : "false";
    c.place.set_field(field.parameter->name, text == unset ? "" : text);
}

void edit_number(PanelContext& c, const FormField& field) {
    const std::string unit = readable_unit(field.parameter->unit);
    const float gap = c.ui.grid(0.75F), wide = ImGui::CalcTextSize(unit.c_str()).x + gap;
    const float room = unit.empty() ? 0 : std::max(c.ui.em * 2.6F, wide);
    edit_text(c, field, ImGui::GetContentRegionAvail().x - room);
    if (unit.empty()) return;
    ImGui::SameLine(0, gap);
    text(c.ui, unit, c.ui.theme.muted);
}

void edit(PanelContext& c, const FormField& field) {
    if (pick_target(*field.parameter)) return edit_place(c, field);
    switch (field.parameter->type) {
        case ParameterType::Flag:
            return edit_flag(c, field);
        case ParameterType::Choice:
            return edit_choice(c, field);
        case ParameterType::File:
            return edit_file(c, field);
        case ParameterType::Text:
            return edit_text(c, field, -1);
        default:
            return edit_number(c, field);
    }
}

void draw_label(const PanelContext& c, const FormField& field, float width) {
    const Ui& ui = c.ui;
    const bool given = !field.text.empty();
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(given ? ui.fonts.medium : ui.fonts.regular);
    const std::string name =
        readable(field.parameter->name) + (field.parameter->required && !given ? " *" : "");
    text(ui, fitted(name, width), given ? ui.theme.text : ui.theme.muted);
    ImGui::PopFont();
}

/// \return true if the mouse or the keyboard is in the field's line
/// What an earlier run or a stroke has to fill in: no user types it.
bool is_recorded(const FormField& field) {
    const Meaning meaning = field.parameter->meaning;
    const bool resolved =
        meaning == Meaning::Planes || meaning == Meaning::Patches || meaning == Meaning::Dabs;
    return resolved && field.text.empty();
}

bool draw_field(PanelContext& c, const FormField& field) {
    const float whole = ImGui::GetContentRegionAvail().x, label = whole * 0.4F;
    const float left = ImGui::GetCursorPosX();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    draw_label(c, field, label - c.ui.grid(1));
    ImGui::SameLine(left + label);
    edit(c, field);
    const bool typing = ImGui::IsItemActive();
    const bool over = ImGui::IsMouseHoveringRect(
        from, {from.x + whole, from.y + ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y});
    if (!field.error.empty()) {
        wrapped(c.ui, field.error, c.ui.theme.danger);
        space(c.ui, 0.5F);
    }
    return typing ||
           (over && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem));
}

}  // namespace

const Parameter* draw_form_fields(PanelContext& c, OperationForm& form) {
    const Parameter* shown = nullptr;
    // Editing a field changes the form: its fields are read one by one.
    for (std::size_t i = 0; i < form.fields().size(); ++i) {
        const FormField field = form.fields()[i];
        if (field.active && !is_recorded(field) && draw_field(c, field)) shown = field.parameter;
    }
    return shown;
}

}  // namespace vesselbench
