#include "workbench/window/fields/form_fields.h"

#include <algorithm>
#include <functional>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/fields/label_rows.h"
#include "workbench/window/form/automatic_values.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

struct FieldPanel {
    PanelContext& c;
    const FieldSink& sink;
    std::string wanted;  ///< the parameter whose field gets the keyboard now; empty: none

    /// The name of a field's item.
    [[nodiscard]] std::string item(const FormField& field) const {
        return sink.prefix + field.parameter->name;
    }
};

/// What an empty field says: nothing takes the place of a file that was not given.
std::string hint_of(const FormField& field) {
    const Parameter& parameter = *field.parameter;
    const bool file = parameter.type == ParameterType::File && !parameter.required;
    return file ? "none" : unset_text(field);
}

void edit_text(const FieldPanel& p, const FormField& field, float width) {
    std::string text = field.text;
    if (text_field(p.c.ui, p.item(field), text,
                   {.hint = hint_of(field),
                    .wrong = !field.error.empty(),
                    .width = width,
                    .focus = field.parameter->name == p.wanted}))
        p.sink.set(field.parameter->name, text);
}

void edit_file(const FieldPanel& p, const FormField& field) {
    const float side = ImGui::GetFrameHeight(), gap = p.c.ui.grid(0.5F);
    const std::string name = field.parameter->name;
    edit_text(p, field, ImGui::GetContentRegionAvail().x - side - gap);
    ImGui::SameLine(0, gap);
    if (icon_button(p.c.ui, p.item(field) + ".browse", icons::kFolder, "Choose a file"))
        p.c.core.ask(FileQuestion::Parameter, name);
}

/// A place, with a button that lets it be picked in the view; listed labels need no text.
void edit_place(const FieldPanel& p, const FormField& field) {
    const float side = ImGui::GetFrameHeight(), gap = p.c.ui.grid(0.5F);
    const std::string name = field.parameter->name;
    const float left = ImGui::GetCursorPosX(),
                width = ImGui::GetContentRegionAvail().x - side - gap;
    if (lists_labels(p.c, field))
        draw_label_count(p.c, field);
    else
        edit_text(p, field, width);
    ImGui::SameLine(left + width + gap);
    if (icon_button(p.c.ui, p.item(field) + ".pick", icons::kTarget, "Pick in the view", true,
                    p.c.core.armed() == name))
        p.c.core.arm(name);
}

/// What a choice shows while nothing is given: one of its texts, or that it is automatic.
std::string unset_choice(const FormField& field) {
    const auto& value = field.parameter->default_value;
    return value ? to_text(*value) : unset_text(field);
}

void edit_choice(const FieldPanel& p, const FormField& field) {
    const std::string unset = unset_choice(field);
    std::vector<std::string> options = field.parameter->choices;
    if (std::ranges::count(options, unset) == 0) options.insert(options.begin(), unset);
    std::string chosen = field.text.empty() ? unset : field.text;
    if (choice(p.c.ui, p.item(field), options, chosen))
        p.sink.set(field.parameter->name, chosen == unset ? "" : chosen);
}

void edit_flag(const FieldPanel& p, const FormField& field) {
    const std::string unset = unset_choice(field);
    bool on = (field.text.empty() ? unset : field.text) == "true";
    if (!checkbox(p.c.ui, p.item(field), "", on)) return;
    const std::string text = on ? "true" : "false";
    p.sink.set(field.parameter->name, text == unset ? "" : text);
}

void edit_number(const FieldPanel& p, const FormField& field) {
    const std::string unit = readable_unit(field.parameter->unit);
    const float gap = p.c.ui.grid(0.75F), wide = ImGui::CalcTextSize(unit.c_str()).x + gap;
    const float room = unit.empty() ? 0 : std::max(p.c.ui.em * 2.6F, wide);
    edit_text(p, field, ImGui::GetContentRegionAvail().x - room);
    if (unit.empty()) return;
    ImGui::SameLine(0, gap);
    text(p.c.ui, unit, p.c.ui.theme.muted);
}

void edit(const FieldPanel& p, const FormField& field) {
    if (pick_target(*field.parameter)) return edit_place(p, field);
    switch (field.parameter->type) {
        case ParameterType::Flag:
            return edit_flag(p, field);
        case ParameterType::Choice:
            return edit_choice(p, field);
        case ParameterType::File:
            return edit_file(p, field);
        case ParameterType::Text:
            return edit_text(p, field, -1);
        default:
            return edit_number(p, field);
    }
}

/// \param width of the label's column
/// \return false if the label is too long for it: the field follows in the next line
bool draw_label(const PanelContext& c, const FormField& field, float width) {
    const Ui& ui = c.ui;
    const bool given = !field.text.empty();
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(given ? ui.fonts.medium : ui.fonts.regular);
    const std::string name =
        readable(field.parameter->name) + (field.parameter->required && !given ? " *" : "");
    const bool fits = ImGui::CalcTextSize(name.c_str()).x <= width;
    text(ui, fitted(name, ImGui::GetContentRegionAvail().x),
         given ? ui.theme.text : ui.theme.muted);
    ImGui::PopFont();
    return fits;
}

/// \return true if the mouse or the keyboard is in the field's line
bool draw_field(const FieldPanel& p, const FormField& field) {
    const float whole = ImGui::GetContentRegionAvail().x, label = whole * 0.4F;
    const float left = ImGui::GetCursorPosX();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    if (draw_label(p.c, field, label - p.c.ui.grid(1)))
        ImGui::SameLine(left + label);
    else
        ImGui::SetCursorPosX(left + label);
    edit(p, field);
    const bool typing = ImGui::IsItemActive();
    const bool over = ImGui::IsMouseHoveringRect(
        from, {from.x + whole, ImGui::GetItemRectMax().y + ImGui::GetStyle().ItemSpacing.y});
    if (lists_labels(p.c, field)) draw_label_rows(p.c, field);
    if (!field.error.empty()) {
        wrapped(p.c.ui, field.error, p.c.ui.theme.danger);
        space(p.c.ui, 0.5F);
    }
    return typing ||
           (over && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem));
}

bool is_given(const FormField& field) {
    return !field.text.empty();
}

bool is_decision(const FormField& field) {
    return field.parameter->use == Use::Decision;
}

/// What runs and strokes fill in is no field.
bool is_shown(const FieldPanel& p, const FormField& field) {
    const bool needs_view =
        pick_target(*field.parameter) || field.parameter->type == ParameterType::File;
    return field.active && (p.sink.in_view || !needs_view) && !is_decision(field) &&
           field.parameter->type != ParameterType::Records &&
           (field.parameter->use != Use::IfGiven || is_given(field));
}

bool is_rare(const FormField& field) {
    return field.parameter->use == Use::Rare;
}

/// Editing a field changes the form: its fields are read one by one.
/// \return the parameter under the mouse or with the keyboard; null: none
template <class Wanted>
const Parameter* draw_fields(const FieldPanel& p, const OperationForm& form, const Wanted& wanted) {
    const Parameter* shown = nullptr;
    for (std::size_t i = 0; i < form.fields().size(); ++i) {
        const FormField field = form.fields()[i];
        if (is_shown(p, field) && wanted(field) && draw_field(p, field)) shown = field.parameter;
    }
    return shown;
}

/// Unfolds or folds the fields that are seldom needed; those that are given stay. \return true if
/// all are seen
bool draw_more(const FieldPanel& p, const OperationForm& form) {
    const auto folds = [&](const FormField& field) { return is_shown(p, field) && is_rare(field); };
    const auto count = std::ranges::count_if(form.fields(), folds);
    if (count == 0) return false;
    const std::string name = p.sink.prefix + form.operation().name;
    const bool open = p.c.shown.unfolded_form == name;
    space(p.c.ui, 0.5F);
    if (button(p.c.ui, p.sink.prefix + "more",
               open ? "Less" : "More: " + counted(static_cast<std::size_t>(count), "field"),
               {.icon = open ? icons::kDown : icons::kRight, .quiet = true}))
        p.c.shown.unfolded_form = open ? "" : name;
    return open;
}

/// Names the decisions that are given, by an earlier run or a tool, and lets them be dropped.
void draw_decisions(const FieldPanel& p, const OperationForm& form) {
    std::vector<std::string> names;
    for (const FormField& field : form.fields())
        if (is_decision(field) && field.active && is_given(field))
            names.push_back(field.parameter->name);
    if (names.empty()) return;
    space(p.c.ui, 0.5F);
    wrapped(p.c.ui, "Already decided: " + joined(names), p.c.ui.theme.muted);
    if (button(p.c.ui, p.sink.prefix + "decide", "Decide again",
               {.icon = icons::kRefresh, .help = "Leave this to the operation"}))
        for (const std::string& name : names) p.sink.set(name, "");
}

}  // namespace

const Parameter* draw_form_fields(PanelContext& c, const OperationForm& form,
                                  const FieldSink& sink) {
    const FieldPanel p{c, sink, sink.in_view ? c.core.wanted_field() : ""};
    if (sink.in_view) c.core.want_field({});
    if (!p.wanted.empty() && is_rare(form.field(p.wanted)))
        c.shown.unfolded_form = sink.prefix + form.operation().name;
    const Parameter* usual = draw_fields(p, form, std::not_fn(is_rare));
    const bool all = draw_more(p, form);
    const Parameter* rare = draw_fields(p, form, [all](const FormField& field) {
        return is_rare(field) && (all || is_given(field));
    });
    draw_decisions(p, form);
    return rare != nullptr ? rare : usual;
}

}  // namespace vesselbench
