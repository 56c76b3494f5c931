#include "workbench/window/panels/form_fields.h"

#include <algorithm>
#include <functional>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/model/automatic_values.h"
#include "workbench/window/model/readable.h"
#include "workbench/window/panels/label_rows.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

std::string item_name(const Parameter& parameter) {
    return "field." + parameter.name;
}

/// What an empty field says: nothing takes the place of a file that was not given.
std::string hint_of(const FormField& field) {
    const Parameter& parameter = *field.parameter;
    const bool file = parameter.type == ParameterType::File && !parameter.required;
    return file ? "none" : unset_text(field);
}

void edit_text(PanelContext& c, const FormField& field, float width) {
    std::string text = field.text;
    if (text_field(c.ui, item_name(*field.parameter), text,
                   {.hint = hint_of(field), .wrong = !field.error.empty(), .width = width}))
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

/// A place, with a button that lets it be picked in the view; listed labels need no text.
void edit_place(PanelContext& c, const FormField& field) {
    const float side = ImGui::GetFrameHeight(), gap = c.ui.grid(0.5F);
    const std::string name = field.parameter->name;
    const float left = ImGui::GetCursorPosX(),
                width = ImGui::GetContentRegionAvail().x - side - gap;
    if (lists_labels(c, field))
        draw_label_count(c, field);
    else
        edit_text(c, field, width);
    ImGui::SameLine(left + width + gap);
    if (icon_button(c.ui, item_name(*field.parameter) + ".pick", icons::kTarget, "Pick in the view",
                    true, c.place.armed() == name))
        c.place.arm(name);
}

/// What a choice shows while nothing is given: one of its texts, or that it is automatic.
std::string unset_choice(const FormField& field) {
    const auto& value = field.parameter->default_value;
    return value ? to_text(*value) : unset_text(field);
}

void edit_choice(PanelContext& c, const FormField& field) {
    const std::string unset = unset_choice(field);
    std::vector<std::string> options = field.parameter->choices;
    if (std::ranges::count(options, unset) == 0) options.insert(options.begin(), unset);
    std::string chosen = field.text.empty() ? unset : field.text;
    if (choice(c.ui, item_name(*field.parameter), options, chosen))
        c.place.set_field(field.parameter->name, chosen == unset ? "" : chosen);
}

void edit_flag(PanelContext& c, const FormField& field) {
    const std::string unset = unset_choice(field);
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
    if (lists_labels(c, field)) draw_label_rows(c, field);
    if (!field.error.empty()) {
        wrapped(c.ui, field.error, c.ui.theme.danger);
        space(c.ui, 0.5F);
    }
    return typing ||
           (over && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem));
}

bool is_given(const FormField& field) {
    return !field.text.empty();
}

/// What an earlier run or a stroke fills in is no field until it has.
bool is_shown(const FormField& field) {
    return field.active && (field.parameter->use != Use::Recorded || is_given(field));
}

bool is_rare(const FormField& field) {
    return field.parameter->use == Use::Rare;
}

/// Editing a field changes the form: its fields are read one by one.
/// \return the parameter under the mouse or with the keyboard; null: none
template <class Wanted>
const Parameter* draw_fields(PanelContext& c, const OperationForm& form, const Wanted& wanted) {
    const Parameter* shown = nullptr;
    for (std::size_t i = 0; i < form.fields().size(); ++i) {
        const FormField field = form.fields()[i];
        if (is_shown(field) && wanted(field) && draw_field(c, field)) shown = field.parameter;
    }
    return shown;
}

/// Unfolds or folds the fields that are seldom needed; those that are given stay. \return true if
/// all are seen
bool draw_more(PanelContext& c, const OperationForm& form) {
    const auto folds = [](const FormField& field) { return is_shown(field) && is_rare(field); };
    const auto count = std::ranges::count_if(form.fields(), folds);
    if (count == 0) return false;
    const std::string& name = form.operation().name;
    const bool open = c.shown.unfolded_form == name;
    space(c.ui, 0.5F);
    if (button(c.ui, "field.more",
               open ? "Less" : "More: " + counted(static_cast<std::size_t>(count), "field"),
               {.icon = open ? icons::kDown : icons::kRight, .quiet = true}))
        c.shown.unfolded_form = open ? "" : name;
    return open;
}

}  // namespace

const Parameter* draw_form_fields(PanelContext& c, OperationForm& form) {
    const Parameter* usual = draw_fields(c, form, std::not_fn(is_rare));
    const bool all = draw_more(c, form);
    const Parameter* rare = draw_fields(c, form, [all](const FormField& field) {
        return is_rare(field) && (all || is_given(field));
    });
    return rare != nullptr ? rare : usual;
}

}  // namespace vesselbench
