#include "workbench/window/panels/rail_panel.h"

#include <algorithm>
#include <set>
#include <span>
#include <string_view>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/row.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

struct StateLook {
    const char* icon;
    Paint colour;
    const char* words;
};

StateLook look_of(const Theme& theme, StepState state) {
    switch (state) {
        case StepState::Empty:
            return {"", theme.muted, "no edits yet"};
        case StepState::Done:
            return {icons::kDone, theme.good, "done"};
        case StepState::Warnings:
            return {icons::kWarning, theme.warning, "done, with warnings"};
        case StepState::Pending:
            return {icons::kPending, theme.accent, "pending: an earlier edit has changed"};
        case StepState::Stale:
            return {icons::kStale, theme.danger, "an edit no longer applies"};
    }
    return {"", theme.muted, ""};
}

/// The edit as a reviewer rejects it; null: nobody does.
const ReviewedEdit* find_rejected(const PanelContext& c, const RailEdit& edit) {
    return c.place.get<ReviewFeature>().rejected({edit.id, edit.revision});
}

/// That a reviewer rejects an edit hides that it is done, and nothing worse.
StateLook look_of(const PanelContext& c, StepState state, std::span<const RailEdit> edits) {
    const bool done = state == StepState::Done || state == StepState::Warnings;
    const auto rejected = [&](const RailEdit& edit) { return find_rejected(c, edit) != nullptr; };
    if (done && std::ranges::any_of(edits, rejected))
        return {icons::kError, c.ui.theme.danger, "rejected by a reviewer"};
    return look_of(c.ui.theme, state);
}

/// The step's number in a circle, or the icon of its state.
void draw_badge(const Ui& ui, const RailStep& step, const StateLook& look, ImVec2 middle) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const std::string sign =
        *look.icon == '\0' ? std::to_string(static_cast<int>(step.step)) : std::string(look.icon);
    if (*look.icon == '\0')
        draw.AddCircle(middle, ui.em * 0.62F, faded(ui.theme.muted, 0.6), 0, ui.em / 15);
    ImFont* font = *look.icon == '\0' ? ui.fonts.small : ui.fonts.heading;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6F, 0, sign.c_str());
    draw.AddText(font, font->FontSize, {middle.x - size.x / 2, middle.y - size.y / 2}, look.colour,
                 sign.c_str());
}

/// The state of the review, or the number of edits.
std::string right_of(const PanelContext& c, const RailStep& step) {
    const auto& review = c.place.get<ReviewFeature>().review();
    if (step.step == Step::Review && review && review->files > 0)
        return to_string(status_of(*review));
    return step.edits.empty() ? "" : std::to_string(step.edits.size());
}

void draw_step(PanelContext& c, const RailStep& step) {
    const Ui& ui = c.ui;
    const bool selected =
        c.place.step() == step.step && !(c.place.form() && c.place.form()->edit());
    const StateLook look = look_of(c, step.state, step.edits);
    if (row(c.ui, "rail." + to_string(step.step),
            {.title = step.title,
             .right = right_of(c, step),
             .selected = selected,
             .strong = !step.edits.empty(),
             .enabled = c.place.document.is_open(),
             .indent = ui.em * 1.9F,
             .help = step.purpose + "\n" + look.words}))
        c.place.choose_step(step.step);
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    draw_badge(ui, step, look, {from.x + ui.em * 1.2F, (from.y + to.y) / 2});
}

std::string help_of(const RailEdit& edit) {
    std::string help = edit.operation + (edit.arguments.empty() ? "" : " " + edit.arguments);
    if (!edit.change.empty()) help += "\n" + edit.change;
    if (!edit.reason.empty()) help += "\nno longer applies: " + edit.reason;
    for (const std::string& warning : edit.warnings) help += "\nwarning: " + warning;
    for (const std::string& note : edit.notes) help += "\nnote: " + note;
    return help + "\nClick to change its parameters.";
}

/// The second line of an edit.
std::string detail_of(const PanelContext& c, const RailEdit& edit) {
    if (!edit.reason.empty()) return edit.reason;
    if (const ReviewedEdit* rejected = find_rejected(c, edit)) return remark_of(*rejected);
    return edit.change.empty() ? edit.arguments : edit.change;
}

void draw_edit(PanelContext& c, const RailEdit& edit) {
    const std::string detail = detail_of(c, edit);
    const float height = row_height(c.ui, !detail.empty());
    if (!ImGui::IsRectVisible({ImGui::GetWindowWidth(), height})) return ImGui::Dummy({1, height});
    const auto& form = c.place.form();
    const StepState state = state_of(edit);
    const bool rejected = find_rejected(c, edit) != nullptr;
    const StateLook look = look_of(c, state, {&edit, 1});
    const std::string name = "rail.edit." + std::to_string(edit.id);
    if (row(c.ui, name,
            {.icon = state == StepState::Done && !rejected ? "" : look.icon,
             .icon_colour = look.colour,
             .title = readable(edit.operation),
             .detail = detail,
             .right = edit.revision > 1 ? "rev. " + std::to_string(edit.revision) : "",
             .selected = (form && form->edit() == edit.id) || c.place.pointed_edit() == edit.id,
             .indent = c.ui.em * 1.9F,
             .help = form && form->edit() == edit.id ? "" : help_of(edit)}))
        c.place.choose_edit(edit.id);
    if (ImGui::IsItemHovered()) c.place.point_at_edit(edit.id);
}

/// True if one of the row's edits is what the form or the pointer is about.
bool is_lit(const PanelContext& c, const RailStep& step, const RailRow& strokes) {
    const auto& form = c.place.form();
    const auto lit = [&](const RailEdit& edit) {
        return (form && form->edit() == edit.id) || c.place.pointed_edit() == edit.id;
    };
    const auto first = step.edits.begin() + static_cast<std::ptrdiff_t>(strokes.first);
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(strokes.count), lit);
}

/// \return true if the strokes are listed one by one
bool draw_strokes(PanelContext& c, const RailStep& step, const RailRow& strokes) {
    const RailEdit& first = step.edits[strokes.first];
    std::set<EditId>& unfolded = c.shown.unfolded;
    const bool open = unfolded.contains(first.id);
    const StepState state = state_of(step, strokes);
    const StateLook look =
        look_of(c, state, std::span(step.edits).subspan(strokes.first, strokes.count));
    const bool plain = look.icon == std::string_view(icons::kDone);
    const char* fold = open ? icons::kDown : icons::kRight;
    if (row(c.ui, "rail.strokes." + std::to_string(first.id),
            {.icon = plain ? fold : look.icon,
             .icon_colour = plain ? c.ui.theme.muted : look.colour,
             .title = readable(first.operation),
             .right = std::to_string(strokes.count) + " strokes",
             .selected = !open && is_lit(c, step, strokes),
             .indent = c.ui.em * 1.9F,
             .help = open ? "Show the strokes in one row" : "List the strokes one by one"})) {
        if (open)
            unfolded.erase(first.id);
        else
            unfolded.insert(first.id);
    }
    return open;
}

void draw_edits(PanelContext& c, const RailStep& step) {
    for (const RailRow& each : rail_rows(step)) {
        if (each.count > 1 && !draw_strokes(c, step, each)) continue;
        for (std::size_t i = each.first; i < each.first + each.count; ++i)
            draw_edit(c, step.edits[i]);
    }
}

}  // namespace

void draw_rail(PanelContext& c, const ScreenRect& rect) {
    begin_frame(c.ui, "rail", rect, {.padding = c.ui.grid(1)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, c.ui.grid(0.25F)});
    ImGui::SetCursorPosX(c.ui.grid(2));
    group_heading(c.ui, "Steps");
    ImGui::Dummy({0, c.ui.grid(0.25F)});
    for (const RailStep& step : c.place.rail()) {
        draw_step(c, step);
        draw_edits(c, step);
    }
    ImGui::PopStyleVar();
    end_frame();
}

}  // namespace vesselbench
