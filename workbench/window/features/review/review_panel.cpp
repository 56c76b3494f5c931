#include "workbench/window/features/review/review_panel.h"

#include <imgui.h>

#include "geometry/kernel/printable.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_judging.h"
#include "workbench/window/features/review/review_layout.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/keys/key_table.h"
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

void draw_state(PanelContext& c, const Review& review) {
    const StatusLook look = look_of(c.ui.theme, status_of(review));
    review_line(c, readable_sentence(review_words(review)), look.colour);
}

void draw_files(PanelContext& c) {
    const Document& document = c.core.document;
    float width = begin_review_controls(c, 1);
    if (button(c.ui, "review.page", "Write review page",
               {.icon = icons::kExport,
                .enabled = document.can(RequestKind::Output),
                .width = width,
                .help = "Write one file that reviewers open in a browser"}))
        c.core.ask(FileQuestion::ReviewPage);
    width = begin_review_controls(c, 1);
    if (button(c.ui, "review.import", "Import verdicts",
               {.icon = icons::kOpen,
                .enabled = document.can(RequestKind::History),
                .width = width,
                .help = "Enter verdicts that reviewers saved from the page, one file or several"}))
        c.core.ask(FileQuestion::Verdicts);
}

void draw_queue(PanelContext& c, ReviewFeature& feature) {
    if (!feature.queue()) {
        const float width = begin_review_controls(c, 1);
        if (button(c.ui, "review.find", "What to look at first",
                   {.icon = icons::kTarget,
                    .enabled = c.core.document.can(RequestKind::Output),
                    .width = width,
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

void draw_verdicts(PanelContext& c, const std::vector<GivenVerdict>& verdicts) {
    for (const GivenVerdict& given : verdicts) {
        review_line(c, verdict_words(given), c.ui.theme.text);
        if (!given.comment.empty()) review_line(c, printable(given.comment), c.ui.theme.muted);
    }
}

void draw_mark_row(PanelContext& c, const std::string& name, const char* icon,
                   const std::string& words, const Vec3& place) {
    if (row(c.ui, name,
            {.icon = icon, .title = words, .help = "Show the place in the view and in the slices"}))
        c.core.look_at(place);
}

void draw_given_marks(PanelContext& c, const ReviewedEdit& edit) {
    for (std::size_t i = 0; i < edit.pins.size(); ++i)
        draw_mark_row(c, "review.pin." + std::to_string(i), icons::kTarget, pin_words(edit.pins[i]),
                      edit.pins[i].pin.place);
    for (std::size_t i = 0; i < edit.distances.size(); ++i) {
        const ReviewedDistance& distance = edit.distances[i].distance;
        draw_mark_row(c, "review.distance." + std::to_string(i), icons::kRuler,
                      distance_words(edit.distances[i]), (distance.from + distance.to) / 2);
    }
}

/// What an edit's models and parameters are looked at with.
void draw_looking(PanelContext& c, ReviewFeature& feature, const ReviewedEdit& edit) {
    const bool rejected = is_rejected(edit), blinks = feature.blink().edit().has_value();
    const std::string reason = blinks ? "" : feature.blink().why_not(edit.edit.id);
    float width = begin_review_controls(c, 1);
    if (button(c.ui, "review.blink", blinks ? "End blinking" : "Blink before and after",
               {.icon = icons::kCompare,
                .enabled = reason.empty(),
                .width = width,
                .help = reason.empty() ? "The models before and after this edit in turn  " +
                                             keys_of(KeyCommand::BlinkEdit)
                                       : "Not now: " + reason}))
        feature.switch_blink();
    width = begin_review_controls(c, 1);
    if (button(c.ui, "review.correct", rejected ? "Correct this edit" : "Show its parameters",
               {.icon = icons::kEdit, .primary = rejected, .width = width}))
        feature.correct();
}

/// Below the row of the chosen edit.
void draw_chosen(PanelContext& c, ReviewFeature& feature, const ReviewedEdit& edit) {
    draw_verdicts(c, edit.verdicts);
    draw_given_marks(c, edit);
    space(c.ui, 0.5F);
    draw_judging(c, feature);
    space(c.ui, 0.5F);
    draw_looking(c, feature, edit);
    space(c.ui, 1);
}

/// "J, K": of the next edit and the previous one.
std::string step_keys() {
    return keys_of(KeyCommand::NextEdit) + ", " + keys_of(KeyCommand::PreviousEdit);
}

/// What an edit's row says while another one is chosen.
std::string detail_of(const ReviewFeature& feature, EditId edit,
                      const std::vector<GivenVerdict>& verdicts) {
    return feature.has_draft(edit) ? "Your draft is not entered yet" : remark_of(verdicts);
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
             .detail = is_chosen ? "" : detail_of(feature, id, edit.verdicts),
             .right = to_string(edit.status),
             .selected = is_chosen || c.core.pointed_edit() == id,
             .help = "Show its place, its verdicts, and judge it  " + step_keys()}))
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

/// Behind all edits: the verdict on what they make together.
void draw_whole(PanelContext& c, ReviewFeature& feature, const Review& review) {
    const ReviewStatus status = status_of_whole(review);
    const StatusLook look = look_of(c.ui.theme, status);
    const bool is_chosen = feature.judges_whole();
    space(c.ui, 1);
    ImGui::SetCursorPosX(c.ui.grid(2));
    group_heading(c.ui, "Together");
    if (row(c.ui, "review.whole",
            {.icon = look.icon,
             .icon_colour = look.colour,
             .title = "The whole model",
             .detail = is_chosen ? "" : detail_of(feature, kWholeModel, review.overall),
             .right = to_string(status),
             .selected = is_chosen,
             .help = "Show the verdicts on the model as a whole, and judge it  " + step_keys()}))
        return feature.choose(kWholeModel);
    if (!is_chosen) return;
    if (feature.take_reveals()) ImGui::SetScrollHereY(0.5F);
    draw_verdicts(c, review.overall);
    space(c.ui, 0.5F);
    draw_judging(c, feature);
}

}  // namespace

void draw_review_panel(PanelContext& c) {
    if (!c.core.document.is_open()) return;
    ReviewFeature& feature = c.core.get<ReviewFeature>();
    const std::shared_ptr<const Review> review = feature.review();
    if (review) draw_state(c, *review);
    if (!feature.problem().empty()) review_line(c, feature.problem(), c.ui.theme.danger);
    space(c.ui, 1);
    draw_files(c);
    if (!review) return;
    draw_queue(c, feature);
    draw_edits(c, feature, *review);
    draw_whole(c, feature, *review);
}

}  // namespace vesselbench
