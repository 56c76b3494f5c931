#include "workbench/window/panels/operation_panel.h"

#include <algorithm>
#include <optional>

#include <imgui.h>

#include "workbench/case/parameter_texts.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/remedies.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/features/brush/brush_form.h"
#include "workbench/window/features/extraction/extraction_panel.h"
#include "workbench/window/features/handles/handles_feature.h"
#include "workbench/window/features/openings/openings_panel.h"
#include "workbench/window/features/result/result_feature.h"
#include "workbench/window/features/result/result_panel.h"
#include "workbench/window/features/review/review_panel.h"
#include "workbench/window/fields/form_fields.h"
#include "workbench/window/form/field_text.h"
#include "workbench/window/panels/live_panel.h"
#include "workbench/window/panels/message_panel.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/row.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

void draw_operation_row(PanelContext& c, const Operation& operation) {
    if (row(c.ui, "choose." + operation.name,
            {.title = readable(operation.name),
             .detail = readable_sentence(operation.summary),
             .enabled = c.place.document.is_open(),
             .help = readable_sentence(operation.summary)}))
        c.place.choose(operation.name, c.place.step());
}

void draw_group(PanelContext& c, const std::string& title, Step step, bool usual) {
    bool any = false;
    for (const Operation& operation : operation_table()) {
        const bool is_usual = operation.usual_step == step;
        const bool allowed = std::ranges::count(operation.allowed, step) > 0;
        if (usual ? !is_usual : (is_usual || !allowed)) continue;
        if (!any && !title.empty()) {
            space(c.ui, 1);
            ImGui::SetCursorPosX(c.ui.grid(2));
            group_heading(c.ui, title);
        }
        any = true;
        draw_operation_row(c, operation);
    }
    if (any || !usual || step == Step::Review) return;
    ImGui::SetCursorPosX(c.ui.grid(2));
    wrapped(c.ui, "No operation of this version belongs to this step.", c.ui.theme.muted);
}

/// What the last step is for is no operation: it changes nothing.
void draw_review(PanelContext& c) {
    draw_review_panel(c);
    space(c.ui, 1);
    ImGui::SetCursorPosX(c.ui.grid(2));
    const float width = ImGui::GetContentRegionAvail().x - c.ui.grid(2);
    if (button(c.ui, "review.export", "Export the model",
               {.icon = icons::kExport,
                .enabled = c.place.document.can(RequestKind::Output),
                .width = width}))
        c.place.ask(FileQuestion::Export);
}

void draw_list(PanelContext& c, const ScreenRect& rect) {
    begin_frame(c.ui, "operations", rect, {.padding = c.ui.grid(1)});
    const RailStep& step = c.place.rail().at(static_cast<std::size_t>(c.place.step()) - 1);
    ImGui::Dummy({0, 0});
    ImGui::SetCursorPos({c.ui.grid(2), c.ui.grid(1.75F)});
    heading(c.ui, step.title);
    ImGui::SetCursorPosX(c.ui.grid(2));
    wrapped(c.ui, step.purpose, c.ui.theme.muted);
    space(c.ui, 1.5F);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, c.ui.grid(0.25F)});
    draw_group(c, "", step.step, true);
    draw_group(c, "Also allowed here", step.step, false);
    if (step.step == Step::Review) draw_review(c);
    ImGui::PopStyleVar();
    end_frame();
}

bool shows_live(const PanelContext& c) {
    return c.place.has_live_form() && c.shown.form == FormTab::Live;
}

/// What a brush paints is known once it has painted: its strokes are edits of their own.
bool paints(const OperationForm& form) {
    return is_brush(form.operation()) && !form.edit() && text_of(form, "dabs").empty() &&
           text_of(form, "at").empty();
}

void draw_title(PanelContext& c, const OperationForm& form) {
    if (icon_button(c.ui, "operation.back", icons::kLeft, "Back to the operations"))
        return c.place.leave_form();
    ImGui::SameLine(0, c.ui.grid(0.5F));
    ImGui::AlignTextToFramePadding();
    heading(c.ui, readable(form.operation().name));
    const float side = ImGui::GetFrameHeight();
    ImGui::SameLine(ImGui::GetWindowWidth() - c.ui.grid(1.5F) - 2 * side);
    if (icon_button(c.ui, "operation.reset", icons::kRefresh,
                    form.edit() ? "Restore the edit's fields" : "Clear all fields"))
        c.place.reset_form();
    ImGui::SameLine(0, 0);
    if (icon_button(c.ui, "operation.copy", icons::kCopy, "Copy as command\n" + c.place.command(),
                    form.valid() && !paints(form)))
        c.to_clipboard(c.place.command());
}

std::string help_of(const Parameter& parameter) {
    std::string help = readable(parameter.name) + ": " + parameter.help + ".";
    const std::string preset = default_text(parameter);
    if (parameter.type == ParameterType::Flag)
        return help + "  Default: " + (preset == "true" ? "on" : "off") + ".";
    if (parameter.type != ParameterType::Choice)
        help += "  " + readable_sentence(allowed_text(parameter)) + ".";
    return help + "  Default: " + preset + ".";
}

/// The form's edit, if it no longer applies.
const LogEntry* stale_edit(const PanelContext& c) {
    const auto& form = c.place.form();
    if (!form || !form->edit()) return nullptr;
    const LogEntry* entry = find_entry(*c.place.document.snapshot(), *form->edit());
    return entry != nullptr && entry->status == EditStatus::Stale ? entry : nullptr;
}

/// What the form still needs, in the window's words.
std::string need_of(const OperationForm& form) {
    for (const FormField& field : form.fields())
        if (field.parameter->required && field.text.empty())
            return readable(field.parameter->name) + " is needed: " + field.parameter->help + ".";
    return readable_sentence(form.error());
}

std::string live_advice(const PanelContext& c) {
    if (c.place.live().has_form()) return "Drag in a graph, or with the right button in the view.";
    if (c.place.extraction().has_form()) return "Drag in the histogram: the surface follows.";
    return "Drag in a graph to set the value; Preview shows the model.";
}

/// Why the operation cannot run, or the help of a parameter: always in the same place.
void draw_advice(PanelContext& c, const OperationForm& form, const Parameter* parameter) {
    const auto& failure = c.place.document.failure();
    const bool missing =
        !form.valid() && std::ranges::all_of(form.fields(), [](const FormField& field) {
            return field.error.empty();
        });
    if (parameter != nullptr) return wrapped(c.ui, help_of(*parameter), c.ui.theme.muted);
    if (failure) return wrapped(c.ui, failure->text, c.ui.theme.danger);
    if (const LogEntry* stale = stale_edit(c))
        return wrapped(c.ui,
                       "No longer applies: " + reason_of(*stale) +
                           "\nChange its parameters, pick its place again, or remove it.",
                       c.ui.theme.danger);
    if (missing) return wrapped(c.ui, need_of(form), c.ui.theme.warning);
    if (shows_live(c)) return wrapped(c.ui, live_advice(c), c.ui.theme.muted);
    const std::string waiting = c.place.document.why_not_input();
    if (is_brush(form.operation()) && !waiting.empty())
        return wrapped(c.ui, "Nothing can be painted: " + waiting, c.ui.theme.warning);
    if (c.place.get<HandlesFeature>().offered_box())
        return wrapped(c.ui, "Drag the handles of the box, or a rectangle in a slice.",
                       c.ui.theme.muted);
    wrapped(c.ui,
            c.place.get<BrushFeature>().can_paint()
                ? "Drag on the surface to brush: each drag is an edit. [ and ] change the radius, "
                  "with Shift the strength; Shift while dragging smooths, Ctrl inverts."
                : "Point at a field to read about it. Empty fields take their defaults.",
            c.ui.theme.muted);
}

/// What the form's failure is, or why its edit is stale; none: nothing is wrong.
std::optional<Message> problem_of(const PanelContext& c) {
    if (const auto& failure = c.place.document.failure()) return failure;
    if (const LogEntry* stale = stale_edit(c)) return stale_message(*stale);
    return std::nullopt;
}

/// The footer has room for so many.
constexpr std::size_t kMostRemedies = 2;

std::vector<Remedy> shown_remedies(const PanelContext& c, const std::optional<Message>& problem) {
    if (!problem) return {};
    std::vector<Remedy> remedies = remedies_of(c.place.document, *problem);
    remedies.resize(std::min(remedies.size(), kMostRemedies));
    return remedies;
}

void draw_remedies(PanelContext& c) {
    const std::optional<Message> problem = problem_of(c);
    const std::vector<Remedy> remedies = shown_remedies(c, problem);
    for (std::size_t i = 0; i < remedies.size(); ++i) {
        const std::string name = "operation.remedy" + (i == 0 ? "" : "." + std::to_string(i));
        if (button(c.ui, name, remedy_label(problem->operation, remedies[i]),
                   {.icon = icons::kRight, .primary = i == 0, .width = -1}))
            return follow(c.core, *problem, remedies[i]);
    }
}

/// What runs behind the form's edit, or behind the strokes that were painted.
Rerun rerun_behind(const PanelContext& c, const OperationForm& form) {
    const Document& document = c.place.document;
    return paints(form) ? pending_rerun(*document.snapshot(), document.variant())
                        : c.place.following();
}

/// Strokes are edits already: they collect until what follows them is run.
void draw_run(PanelContext& c, bool any, float width) {
    if (!button(c.ui, "operation.run", "Run",
                {.primary = true,
                 .enabled = any && c.place.can_change(),
                 .width = width,
                 .help = "Make the edits again that follow the strokes"}))
        return;
    c.place.leave_form();
    c.place.document.run_pending();
}

void draw_apply(PanelContext& c, const OperationForm& form, bool runs, float width) {
    const bool change = form.edit().has_value();
    const char* verb = change ? "Change" : "Apply";
    const char* both = change ? "Change and run" : "Apply and run";
    const std::string help =
        change ? "Run the edit with these values" : "Run and add it as an edit; can be undone";
    if (button(c.ui, "operation.apply", runs ? both : verb,
               {.primary = true,
                .enabled = c.place.can_apply(),
                .width = width,
                .help = help + (runs ? ". The edits that follow it are made again" : "")}))
        c.place.apply_and_run();
}

void draw_cost(PanelContext& c, const Rerun& rerun) {
    if (rerun.edits == 0) return;
    text(c.ui, "Then runs " + rerun_text(rerun), c.ui.theme.muted);
    c.ui.item("operation.cost");
}

void draw_actions(PanelContext& c, const OperationForm& form) {
    Workplace& place = c.place;
    const Rerun rerun = rerun_behind(c, form);
    draw_cost(c, rerun);
    // "Change and run" needs more room than the others.
    const float room = ImGui::GetContentRegionAvail().x - 2 * c.ui.grid(1);
    const float width = room * 0.29F;
    const bool idle = !place.document.activity().has_value();
    if (button(c.ui, "operation.preview", "Preview",
               {.enabled = form.valid() && place.document.can(RequestKind::Preview),
                .width = width,
                .help = "Run and show the result without adding an edit"}))
        place.preview();
    ImGui::SameLine(0, c.ui.grid(1));
    if (paints(form))
        draw_run(c, rerun.edits > 0, room - 2 * width);
    else
        draw_apply(c, form, rerun.edits > 0, room - 2 * width);
    ImGui::SameLine(0, c.ui.grid(1));
    if (!place.form()) return;
    if (button(c.ui, "operation.cancel", "Cancel",
               {.width = width, .help = "Cancel the running operation, or close this form"})) {
        if (!idle) return place.document.cancel();
        place.leave_form();
    }
}

void draw_note(PanelContext& c, EditId edit) {
    const LogEntry* entry = find_entry(*c.place.document.snapshot(), edit);
    if (entry == nullptr) return;
    const EditRecord* record = &entry->edit;
    const bool noted = !record->note.empty();
    if (button(c.ui, "operation.note", noted ? "Note" : "Add a note",
               {.icon = icons::kNote,
                .width = (ImGui::GetContentRegionAvail().x - c.ui.grid(1)) * 0.4F,
                .help = noted ? record->note : "Write down why this edit was made"}))
        c.shown.note = NoteInProgress{record->edit, readable(record->operation), record->note};
    ImGui::SameLine(0, c.ui.grid(1));
}

void draw_removal(PanelContext& c, EditId edit) {
    const bool idle = c.place.document.can(RequestKind::Edit);
    if (!button(c.ui, "operation.remove", "Remove this edit",
                {.icon = icons::kDelete,
                 .enabled = idle,
                 .width = -1,
                 .help = "Later edits become pending. Undo brings it back"}))
        return;
    c.place.leave_form();
    c.place.document.remove(edit);
}

/// Of what explains fields: where none are seen, graphs need the room.
float advice_height(const PanelContext& c) {
    const bool graphs = shows_live(c);
    return c.ui.em * (graphs && !c.place.document.failure() ? 2.5F : 7.5F);
}

/// Height of the part below the fields.
float footer_height(const PanelContext& c, const OperationForm& form) {
    const float line = ImGui::GetFrameHeightWithSpacing();
    const std::size_t remedies = shown_remedies(c, problem_of(c)).size();
    const float cost = rerun_behind(c, form).edits > 0 ? ImGui::GetTextLineHeightWithSpacing() : 0;
    const float more = (form.edit() ? line : 0) + line * static_cast<float>(remedies) + cost;
    return advice_height(c) + line + more + c.ui.grid(1);
}

void draw_footer(PanelContext& c, const OperationForm& form, const Parameter* parameter) {
    const std::optional<EditId> edit = form.edit();
    separator(c.ui);
    ImGui::BeginChild("advice", {0, advice_height(c) - c.ui.grid(1)});
    draw_advice(c, form, parameter);
    ImGui::EndChild();
    draw_remedies(c);
    if (!c.place.form()) return;
    if (edit) draw_note(c, *edit);
    if (edit) draw_removal(c, *edit);
    if (c.place.form()) draw_actions(c, form);
}

void draw_tab(PanelContext& c, const std::string& name, const std::string& label, FormTab tab) {
    const bool chosen = c.shown.form == tab;
    ImGui::PushFont(chosen ? c.ui.fonts.medium : c.ui.fonts.regular);
    if (button(c.ui, name, label, {.quiet = true})) c.shown.form = tab;
    ImGui::PopFont();
    if (!chosen) return;
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled({from.x, to.y}, {to.x, to.y + c.ui.grid(0.25F)},
                                              c.ui.theme.accent);
}

/// What the form says, or what comes of it. \return the parameter to be explained; null: none
const Parameter* draw_contents(PanelContext& c, OperationForm& form) {
    if (c.place.openings().has_form()) draw_openings_panel(c);
    const auto set = [&](const std::string& parameter, const std::string& text) {
        c.place.set_field(parameter, text);
    };
    if (!shows_live(c)) return draw_form_fields(c, form, {.prefix = "field.", .set = set});
    if (c.place.live().has_form())
        draw_live_panel(c, form);
    else if (c.place.extraction().has_form())
        draw_extraction_panel(c, form);
    else
        draw_quality_panel(c, form);
    return nullptr;
}

void draw_tabs(PanelContext& c) {
    if (!c.place.has_live_form()) return;
    if (!c.place.wanted_field().empty()) c.shown.form = FormTab::Fields;
    draw_tab(c, "form.fields", "Parameters", FormTab::Fields);
    ImGui::SameLine();
    const bool follows = c.place.live().has_form() || c.place.extraction().has_form();
    draw_tab(c, "form.live", follows ? "Live" : "Quality", FormTab::Live);
    separator(c.ui);
}

void draw_form(PanelContext& c, const ScreenRect& rect) {
    begin_frame(c.ui, "operation", rect, {.scrolls = false});
    draw_title(c, *c.place.form());
    if (c.place.form()) {
        OperationForm& form = *c.place.form();
        wrapped(c.ui, readable_sentence(form.operation().summary), c.ui.theme.muted);
        space(c.ui, 1);
        draw_tabs(c);
        const float height = ImGui::GetContentRegionAvail().y - footer_height(c, form);
        ImGui::BeginChild("fields", {0, std::max(height, c.ui.em * 4)});
        const Parameter* parameter = draw_contents(c, form);
        ImGui::EndChild();
        draw_footer(c, form, parameter);
    }
    end_frame();
}

}  // namespace

void draw_operation_panel(PanelContext& c, const ScreenRect& rect) {
    if (c.place.form())
        draw_form(c, rect);
    else if (c.place.get<ResultFeature>().card() != nullptr)
        draw_result_card(c, rect);
    else
        draw_list(c, rect);
}

}  // namespace vesselbench
