#include "workbench/window/features/review/review_judging.h"

#include <imgui.h>

#include "geometry/kernel/printable.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_layout.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/keys/key_table.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

void draw_who(PanelContext& c, ReviewFeature& feature) {
    review_line(c, "Who reviews? Your name is kept with each verdict, and asked for once.",
                c.ui.theme.muted);
    float width = begin_review_controls(c, 1);
    static_cast<void>(
        text_field(c.ui, "review.name", feature.who.name, {.hint = "your name", .width = width}));
    width = begin_review_controls(c, 1);
    static_cast<void>(text_field(c.ui, "review.role", feature.who.role,
                                 {.hint = "your role, such as radiologist", .width = width}));
    width = begin_review_controls(c, 1);
    if (button(c.ui, "review.keep_name", "Review as this person",
               {.primary = true, .enabled = !feature.who.name.empty(), .width = width}))
        feature.keep_who();
}

void draw_comment(PanelContext& c, ReviewFeature& feature) {
    const float width = begin_review_controls(c, 1);
    static_cast<void>(text_field(c.ui, "review.comment", feature.draft().comment,
                                 {.hint = "comment; to reject: the reason",
                                  .width = width,
                                  .focus = feature.takes_keyboard("review.comment")}));
    help_on_hover(c.ui, "Comment  " + keys_of(KeyCommand::CommentEdit));
}

void draw_tool(PanelContext& c, ReviewFeature& feature, ClickTool tool, float width) {
    const bool pin = tool == ClickTool::ReviewPin, on = c.core.view.tool == tool;
    const std::string what = pin ? "Pin" : "Distance", reason = feature.why_not_mark();
    const std::string help =
        pin ? "Mark places by clicks on the surface  " + keys_of(KeyCommand::PlacePin)
            : "Measure from one click on the surface to another  " +
                  keys_of(KeyCommand::PlaceDistance);
    if (button(c.ui, pin ? "review.place_pin" : "review.place_distance", on ? "Stop" : what,
               {.icon = pin ? icons::kTarget : icons::kRuler,
                .primary = on,
                .enabled = reason.empty(),
                .width = width,
                .help = reason.empty() ? help : "Not now: " + reason}))
        feature.switch_tool(tool);
}

/// A mark with its text, a button that looks at it and one that removes it.
/// \return true if it is to be removed
bool draw_mark_line_of(PanelContext& c, ReviewFeature& feature, const std::string& name,
                       std::string& words, const Vec3& place, const std::string& hint) {
    const float side = ImGui::GetFrameHeight(), gap = c.ui.grid(0.5F);
    const float width = begin_review_controls(c, 1) - 2 * (side + gap);
    static_cast<void>(text_field(
        c.ui, name, words, {.hint = hint, .width = width, .focus = feature.takes_keyboard(name)}));
    ImGui::SameLine(0, gap);
    if (icon_button(c.ui, name + ".look", icons::kTarget,
                    "Show the place in the view and in the slices"))
        c.core.look_at(place);
    ImGui::SameLine(0, gap);
    return icon_button(c.ui, name + ".remove", icons::kDelete, "Remove it from your draft");
}

void draw_marks(PanelContext& c, ReviewFeature& feature) {
    VerdictDraft& draft = feature.draft();
    for (std::size_t i = 0; i < draft.pins.size(); ++i) {
        Pin& pin = draft.pins[i];
        if (draw_mark_line_of(c, feature, "review.draft.pin." + std::to_string(i), pin.text,
                              pin.place, "pin " + std::to_string(i + 1) + ": what is here?"))
            return static_cast<void>(
                draft.pins.erase(draft.pins.begin() + static_cast<std::ptrdiff_t>(i)));
    }
    for (std::size_t i = 0; i < draft.distances.size(); ++i) {
        ReviewedDistance& distance = draft.distances[i];
        if (draw_mark_line_of(c, feature, "review.draft.distance." + std::to_string(i),
                              distance.text, (distance.from + distance.to) / 2,
                              length_words(distance) + ": of what?"))
            return static_cast<void>(
                draft.distances.erase(draft.distances.begin() + static_cast<std::ptrdiff_t>(i)));
    }
    if (!draft.pins.empty() || !draft.distances.empty())
        review_line(c, "Marks are entered with the verdict.", c.ui.theme.muted);
}

void draw_verdict_button(PanelContext& c, ReviewFeature& feature, Verdict verdict,
                         const std::string& label, float width) {
    const KeyCommand key = verdict == Verdict::Accept   ? KeyCommand::AcceptEdit
                           : verdict == Verdict::Reject ? KeyCommand::RejectEdit
                                                        : KeyCommand::UnsureEdit;
    const std::string reason = feature.why_not(verdict);
    if (button(c.ui, "review." + to_string(verdict), label,
               {.enabled = reason.empty(),
                .width = width,
                .help = reason.empty() ? label + "  " + keys_of(key) : "Not now: " + reason}))
        feature.give(verdict);
}

void draw_verdict_buttons(PanelContext& c, ReviewFeature& feature) {
    const float width = begin_review_controls(c, 3);
    draw_verdict_button(c, feature, Verdict::Accept, "Accept", width);
    next_review_control(c);
    draw_verdict_button(c, feature, Verdict::Reject, "Reject", width);
    next_review_control(c);
    draw_verdict_button(c, feature, Verdict::Unsure, "Unsure", width);
    ImGui::SetCursorPosX(c.ui.grid(2));
    if (button(c.ui, "review.who", "as " + printable(shortened(c.core.settings.reviewer, 40)),
               {.quiet = true, .help = "Review as another person"}))
        feature.ask_who();
}

}  // namespace

void draw_judging(PanelContext& c, ReviewFeature& feature) {
    if (feature.asks_who()) return draw_who(c, feature);
    draw_comment(c, feature);
    if (!feature.judges_whole()) {
        const float width = begin_review_controls(c, 2);
        draw_tool(c, feature, ClickTool::ReviewPin, width);
        next_review_control(c);
        draw_tool(c, feature, ClickTool::ReviewDistance, width);
        draw_marks(c, feature);
    }
    draw_verdict_buttons(c, feature);
}

}  // namespace vesselbench
