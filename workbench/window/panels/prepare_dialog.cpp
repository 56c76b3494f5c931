#include "workbench/window/panels/prepare_dialog.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "workbench/case/argument_texts.h"
#include "workbench/case/purposes.h"
#include "workbench/window/model/rail.h"
#include "workbench/window/model/readable.h"
#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/row.h"

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
        }
}

/// Missing edits only, or also those of the purpose's own steps from one on.
void draw_extent(PanelContext& c, const ResumedRecipe& resumed) {
    const std::vector<Step> steps =
        repeatable_steps(resumed, *c.place.document.snapshot(), c.shown.purpose);
    const auto text_of = [](const std::optional<Step>& from) {
        return from ? "Again from " + title_of(*from) : std::string("What is missing");
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

void draw_entry(const Ui& ui, const RecipeEntry& entry, int number) {
    const std::string arguments = argument_summary(entry.given.operation(), entry.given);
    text(ui, std::to_string(number) + ".  " + readable(entry.given.operation().name),
         ui.theme.text);
    ImGui::SameLine();
    clipped_text(ui, arguments, ui.theme.muted, ImGui::GetContentRegionAvail().x - ui.grid(1));
}

void draw_entries(PanelContext& c, const ResumedRecipe& resumed) {
    if (!resumed.refusal.empty())
        return wrapped(c.ui, readable_sentence(resumed.refusal), c.ui.theme.danger, false);
    if (resumed.rest.empty())
        return wrapped(c.ui, readable_sentence(all_made_text(resumed)) + ".", c.ui.theme.muted,
                       false);
    group_heading(c.ui, "These edits will be made");
    space(c.ui, 0.5F);
    int number = 0;
    for (const RecipeEntry& entry : resumed.rest) draw_entry(c.ui, entry, ++number);
    if (!c.shown.again_from) return;
    space(c.ui, 0.5F);
    wrapped(c.ui,
            "Those of the model from " + title_of(*c.shown.again_from) +
                " on are left out first; the history keeps them.",
            c.ui.theme.muted);
}

void draw_buttons(PanelContext& c, bool possible) {
    const float width = c.ui.em * 8;
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - c.ui.grid(2.5F) - 2 * width - c.ui.grid(1));
    if (button(c.ui, "prepare.cancel", "Cancel", {.width = width})) c.shown.prepare = false;
    ImGui::SameLine(0, c.ui.grid(1));
    if (!button(c.ui, "prepare.run", "Prepare",
                {.primary = true, .enabled = possible, .width = width}))
        return;
    c.place.leave_form();
    c.place.document.prepare(c.shown.purpose, std::exchange(c.shown.again_from, std::nullopt));
    c.shown.prepare = false;
}

}  // namespace

void draw_prepare_dialog(PanelContext& c, const ScreenRect& window) {
    const Ui& ui = c.ui;
    begin_dialog(ui, "prepare", window, ui.em * 52, ui.em * 29);
    heading(ui, "Prepare the model");
    wrapped(ui,
            "A recipe runs on the case as it is now. Each of its edits can be changed or undone "
            "afterwards.",
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
    draw_entries(c, resumed);
    ImGui::EndChild();
    space(ui, 1);
    draw_buttons(c, resumed.refusal.empty());
    end_frame();
}

}  // namespace vesselbench
