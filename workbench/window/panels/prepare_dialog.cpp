#include "workbench/window/panels/prepare_dialog.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "workbench/case/purposes.h"
#include "workbench/window/case/argument_words.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/fields/form_fields.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/row.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

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
                 .strong = true})) {
            c.shown.purpose = purpose.name;
            c.shown.again_from.reset();
            c.shown.entry.reset();
        }
}

/// Missing edits only, or also those of the purpose's own steps from one on.
void draw_extent(PanelContext& c, const ResumedRecipe& resumed) {
    const std::vector<Step> steps =
        repeatable_steps(resumed, *c.place.document.snapshot(), c.shown.purpose);
    const auto text_of = [](const std::optional<Step>& from) {
        return from ? "Start again from " + title_of(*from) : std::string("What is missing");
    };
    if (c.shown.again_from && std::ranges::count(steps, *c.shown.again_from) == 0)
        c.shown.again_from.reset();
    if (steps.empty()) return;
    std::vector<std::string> texts = {text_of({})};
    for (const Step step : steps) texts.push_back(text_of(step));
    std::string chosen = text_of(c.shown.again_from);
    if (!choice(c.ui, "prepare.extent", texts, chosen)) return;
    const auto found = std::ranges::find(steps, chosen, text_of);
    c.shown.again_from = found == steps.end() ? std::nullopt : std::optional(*found);
}

/// The values of an entry, to be changed before it runs.
void draw_values(PanelContext& c, std::size_t entry) {
    const auto set = [&](const std::string& parameter, const std::string& text) {
        c.place.recipe.set(entry, parameter, text);
    };
    const Parameter* parameter =
        draw_form_fields(c, c.place.recipe.forms()[entry],
                         {.prefix = "prepare.field.", .set = set, .in_view = false});
    if (parameter != nullptr)
        tooltip(c.ui, readable(parameter->name) + ": " + parameter->help + ".");
    space(c.ui, 1);
}

void draw_entry(PanelContext& c, std::size_t entry) {
    const OperationForm& form = c.place.recipe.forms()[entry];
    const bool open = c.shown.entry == entry;
    const std::string number = std::to_string(entry + 1);
    if (row(c.ui, "prepare.entry." + number,
            {.icon = open ? icons::kDown : icons::kRight,
             .title = number + ".  " + readable(form.operation().name),
             .detail = form.valid() ? argument_words(form.operation(), form.arguments()) : "",
             .right = c.place.recipe.is_changed(entry) ? "changed" : "",
             .help = open ? "Hide the values" : "Change the values of this edit"}))
        c.shown.entry = open ? std::nullopt : std::optional(entry);
    if (open) draw_values(c, entry);
}

void draw_entries(PanelContext& c, const ResumedRecipe& resumed) {
    if (!resumed.refusal.empty())
        return wrapped(c.ui, readable_sentence(resumed.refusal), c.ui.theme.danger, false);
    if (resumed.rest.empty())
        return wrapped(c.ui, readable_sentence(all_made_text(resumed)) + ".", c.ui.theme.muted,
                       false);
    group_heading(c.ui, "These edits will be made");
    space(c.ui, 0.5F);
    for (std::size_t i = 0; i < c.place.recipe.forms().size(); ++i) draw_entry(c, i);
    if (!c.shown.again_from) return;
    space(c.ui, 0.5F);
    wrapped(c.ui,
            "The model's edits from " + title_of(*c.shown.again_from) +
                " on are removed first; the history keeps them.",
            c.ui.theme.muted);
}

/// What becomes of changed values beside running them.
void draw_recipe_buttons(PanelContext& c) {
    RecipeDraft& recipe = c.place.recipe;
    if (button(
            c.ui, "prepare.save", "Save as a recipe",
            {.enabled = !recipe.forms().empty() && recipe.error().empty(),
             .help =
                 "Write these edits and values to a file, with which other cases can be prepared"}))
        c.place.ask(FileQuestion::SaveRecipe);
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "prepare.restore", "Restore",
               {.enabled = recipe.is_changed(), .help = "Undo all changes to the values"}))
        recipe.reset();
    ImGui::SameLine();
}

void draw_buttons(PanelContext& c, bool possible) {
    draw_recipe_buttons(c);
    const RecipeDraft& recipe = c.place.recipe;
    const float width = c.ui.em * 8;
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - c.ui.grid(2.5F) - 2 * width - c.ui.grid(1));
    if (button(c.ui, "prepare.cancel", "Cancel", {.width = width})) c.shown.prepare = false;
    ImGui::SameLine(0, c.ui.grid(1));
    const bool ready = possible && !recipe.forms().empty() && recipe.error().empty();
    if (!button(c.ui, "prepare.run", "Prepare",
                {.primary = true, .enabled = ready, .width = width}))
        return;
    c.place.leave_form();
    c.place.document.prepare(c.shown.purpose, std::exchange(c.shown.again_from, std::nullopt),
                             recipe.is_changed() ? std::optional(recipe.recipe()) : std::nullopt);
    c.shown.prepare = false;
}

}  // namespace

void draw_prepare_dialog(PanelContext& c, const ScreenRect& window) {
    const Ui& ui = c.ui;
    begin_dialog(ui, "prepare", window, ui.em * 52, ui.em * 29);
    heading(ui, "Prepare the model");
    wrapped(
        ui,
        "A recipe runs on the case as it is now. Each of its edits can be changed now, or changed "
        "and undone afterwards.",
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
    ResumedRecipe resumed = c.place.document.to_prepare(c.shown.purpose);
    draw_extent(c, resumed);
    if (c.shown.again_from) resumed.rest = rest_from(*c.shown.again_from, resumed);
    c.place.recipe.follow(resumed.rest);
    draw_entries(c, resumed);
    ImGui::EndChild();
    space(ui, 1);
    draw_buttons(c, resumed.refusal.empty());
    end_frame();
}

}  // namespace vesselbench
