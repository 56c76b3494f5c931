#include "workbench/window/features/review/review_panel.h"

#include <imgui.h>

#include "geometry/kernel/printable.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/row.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

struct StatusLook {
    const char* icon;
    Paint colour;
};

StatusLook look_of(const Theme& theme, ReviewStatus status) {
    switch (status) {
        case ReviewStatus::Accepted:
            return {icons::kDone, theme.good};
        case ReviewStatus::Rejected:
            return {icons::kError, theme.danger};
        case ReviewStatus::Disputed:
            return {icons::kWarning, theme.warning};
        case ReviewStatus::Outdated:
            return {icons::kHistory, theme.warning};
        case ReviewStatus::Open:
            break;
    }
    return {icons::kPending, theme.muted};
}

/// A text at the panel's indent.
void line(PanelContext& c, const std::string& words, Paint colour) {
    ImGui::SetCursorPosX(c.ui.grid(2));
    wrapped(c.ui, words, colour);
}

/// [pixels] of controls in a row of so many.
float width_of(const PanelContext& c, int count) {
    const float gaps = c.ui.grid(1) * static_cast<float>(count - 1);
    return (ImGui::GetContentRegionAvail().x - c.ui.grid(2) - gaps) / static_cast<float>(count);
}

void draw_state(PanelContext& c, const Review& review) {
    const StatusLook look = look_of(c.ui.theme, status_of(review));
    line(c, readable_sentence(review_words(review)), look.colour);
    for (const GivenVerdict& given : review.overall)
        line(c, "The whole, " + verdict_words(given), c.ui.theme.muted);
}

void draw_files(PanelContext& c) {
    const Document& document = c.core.document;
    ImGui::SetCursorPosX(c.ui.grid(2));
    if (button(c.ui, "review.page", "Write review page",
               {.icon = icons::kExport,
                .enabled = document.can(RequestKind::Output),
                .width = width_of(c, 1),
                .help = "Write one file that reviewers open in a browser"}))
        c.core.ask(FileQuestion::ReviewPage);
    ImGui::SetCursorPosX(c.ui.grid(2));
    if (button(c.ui, "review.import", "Import verdicts",
               {.icon = icons::kOpen,
                .enabled = document.can(RequestKind::History),
                .width = width_of(c, 1),
                .help = "Enter verdicts that a reviewer saved from the page"}))
        c.core.ask(FileQuestion::Verdicts);
}

void draw_queue(PanelContext& c, ReviewFeature& feature) {
    if (!feature.queue()) {
        ImGui::SetCursorPosX(c.ui.grid(2));
        if (button(c.ui, "review.find", "What to look at first",
                   {.icon = icons::kTarget,
                    .enabled = c.core.document.can(RequestKind::Output),
                    .width = width_of(c, 1),
                    .help = "Large changes, warnings, decisions in doubt; reads all models"}))
            feature.find_queue();
        return;
    }
    space(c.ui, 1);
    ImGui::SetCursorPosX(c.ui.grid(2));
    group_heading(c.ui, feature.queue()->empty() ? "Nothing stands out" : "To look at first");
    for (std::size_t i = 0; i < feature.queue()->size(); ++i) {
        const QueueItem& item = (*feature.queue())[i];
        if (row(c.ui, "review.queue." + std::to_string(i),
                {.title = printable(item.title),
                 .detail = "Edit " + std::to_string(item.edit) + ": " + printable(item.why),
                 .help = printable(item.why)}))
            feature.look_at(item);
    }
}

void draw_verdicts(PanelContext& c, const ReviewedEdit& edit) {
    for (const GivenVerdict& given : edit.verdicts) {
        line(c, verdict_words(given), c.ui.theme.text);
        if (!given.comment.empty()) line(c, printable(given.comment), c.ui.theme.muted);
    }
    for (std::size_t i = 0; i < edit.pins.size(); ++i)
        if (row(c.ui, "review.pin." + std::to_string(i),
                {.icon = icons::kTarget,
                 .title = pin_words(edit.pins[i]),
                 .help = "Show the place in the view and in the slices"}))
            c.core.look_at(edit.pins[i].pin.place);
}

void draw_who(PanelContext& c, ReviewFeature& feature) {
    line(c, "Who reviews? Your name is kept with each verdict, and asked for once.",
         c.ui.theme.muted);
    ImGui::SetCursorPosX(c.ui.grid(2));
    const float width = width_of(c, 1);
    static_cast<void>(
        text_field(c.ui, "review.name", feature.who.name, {.hint = "your name", .width = width}));
    ImGui::SetCursorPosX(c.ui.grid(2));
    static_cast<void>(text_field(c.ui, "review.role", feature.who.role,
                                 {.hint = "your role, such as radiologist", .width = width}));
    ImGui::SetCursorPosX(c.ui.grid(2));
    if (button(c.ui, "review.keep_name", "Review as this person",
               {.primary = true, .enabled = !feature.who.name.empty(), .width = width}))
        feature.keep_who();
}

void draw_verdict_button(PanelContext& c, ReviewFeature& feature, Verdict verdict,
                         const std::string& label, float width) {
    const std::string reason = feature.why_not(verdict);
    if (button(c.ui, "review." + to_string(verdict), label,
               {.enabled = reason.empty(),
                .width = width,
                .help = reason.empty() ? "" : "Not now: " + reason}))
        feature.give(verdict);
}

void draw_judging(PanelContext& c, ReviewFeature& feature) {
    ImGui::SetCursorPosX(c.ui.grid(2));
    static_cast<void>(
        text_field(c.ui, "review.comment", feature.comment,
                   {.hint = "comment; to reject: the reason", .width = width_of(c, 1)}));
    ImGui::SetCursorPosX(c.ui.grid(2));
    const float width = width_of(c, 3);
    draw_verdict_button(c, feature, Verdict::Accept, "Accept", width);
    ImGui::SameLine(0, c.ui.grid(1));
    draw_verdict_button(c, feature, Verdict::Reject, "Reject", width);
    ImGui::SameLine(0, c.ui.grid(1));
    draw_verdict_button(c, feature, Verdict::Unsure, "Unsure", width);
    ImGui::SetCursorPosX(c.ui.grid(2));
    if (button(c.ui, "review.who", "as " + printable(shortened(c.core.settings.reviewer, 40)),
               {.quiet = true, .help = "Review as another person"}))
        feature.ask_who();
}

/// Below the row of the chosen edit.
void draw_chosen(PanelContext& c, ReviewFeature& feature, const ReviewedEdit& edit) {
    draw_verdicts(c, edit);
    space(c.ui, 0.5F);
    if (feature.asks_who())
        draw_who(c, feature);
    else
        draw_judging(c, feature);
    space(c.ui, 0.5F);
    ImGui::SetCursorPosX(c.ui.grid(2));
    const bool rejected = is_rejected(edit);
    if (button(c.ui, "review.correct", rejected ? "Correct this edit" : "Show its parameters",
               {.icon = icons::kEdit, .primary = rejected, .width = width_of(c, 1)}))
        feature.correct();
    space(c.ui, 1);
}

void draw_edit(PanelContext& c, ReviewFeature& feature, const ReviewedEdit& edit) {
    const StatusLook look = look_of(c.ui.theme, edit.status);
    const EditId id = edit.edit.id;
    const ReviewedEdit* chosen = feature.chosen();
    const bool is_chosen = chosen == &edit;
    if (row(c.ui, "review.edit." + std::to_string(id),
            {.icon = look.icon,
             .icon_colour = look.colour,
             .title = readable(edit.operation),
             .detail = is_chosen ? "" : remark_of(edit),
             .right = to_string(edit.status),
             .selected = is_chosen || c.core.pointed_edit() == id,
             .help = "Show its place, its verdicts, and judge it"}))
        return feature.choose(id);
    if (ImGui::IsItemHovered()) c.core.point_at_edit(id);
    if (!is_chosen) return;
    if (feature.take_reveals()) ImGui::SetScrollHereY(0.2F);
    draw_chosen(c, feature, edit);
}

void draw_edits(PanelContext& c, ReviewFeature& feature, const Review& review) {
    std::optional<Step> step;
    for (const ReviewedEdit& edit : review.edits) {
        if (step != edit.place.step) {
            step = edit.place.step;
            space(c.ui, 1);
            ImGui::SetCursorPosX(c.ui.grid(2));
            group_heading(c.ui, title_of(*step));
        }
        draw_edit(c, feature, edit);
    }
}

}  // namespace

void draw_review_panel(PanelContext& c) {
    if (!c.core.document.is_open()) return;
    ReviewFeature& feature = c.core.get<ReviewFeature>();
    const std::shared_ptr<const Review> review = feature.review();
    if (review) draw_state(c, *review);
    if (!feature.problem().empty()) line(c, feature.problem(), c.ui.theme.danger);
    space(c.ui, 1);
    draw_files(c);
    if (!review) return;
    draw_queue(c, feature);
    draw_edits(c, feature, *review);
}

}  // namespace vesselbench
