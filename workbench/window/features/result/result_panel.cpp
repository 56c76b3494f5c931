#include "workbench/window/features/result/result_panel.h"

#include <algorithm>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/result/result_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"

namespace vesselbench {

namespace {

void draw_head(PanelContext& c, const ResultCard& card) {
    ImGui::AlignTextToFramePadding();
    heading(c.ui, card.model);
    ImGui::SameLine(ImGui::GetWindowWidth() - c.ui.grid(1.5F) - ImGui::GetFrameHeight());
    if (icon_button(c.ui, "result.close", icons::kClose, "Close this card"))
        c.core.get<ResultFeature>().close();
    wrapped(c.ui, card.what, c.ui.theme.muted);
    space(c.ui, 1);
}

/// A figure with what it was.
void draw_figure(const Ui& ui, const ResultRow& figure) {
    const float middle = ImGui::GetWindowWidth() * 0.42F;
    text(ui, figure.name, ui.theme.muted);
    if (ImGui::CalcTextSize(figure.name.c_str()).x + ui.grid(2) < middle) ImGui::SameLine(middle);
    wrapped(ui, figure.after, ui.theme.text, false);
    if (figure.before.empty() || figure.before == figure.after) return;
    ImGui::SetCursorPosX(middle);
    wrapped(ui, "before: " + figure.before, ui.theme.muted);
}

/// A button over the whole width.
bool step_button(PanelContext& c, const std::string& name, const std::string& label,
                 const ButtonLook& look) {
    ButtonLook wide = look;
    wide.width = -1;
    return button(c.ui, name, label, wide);
}

void draw_warnings(PanelContext& c, std::size_t warnings) {
    if (warnings == 0) return;
    if (!step_button(c, "result.warnings", "Read " + counted(warnings, "warning"),
                     {.icon = icons::kWarning, .help = "The messages below the view"}))
        return;
    c.shown.bottom = BottomTab::Messages;
    c.core.settings.panels[Panel::Bottom].folded = false;
}

void draw_next(PanelContext& c, const ResultCard& card) {
    group_heading(c.ui, "Next");
    space(c.ui, 0.5F);
    const bool compares = card.can_compare;
    draw_warnings(c, card.warnings);
    if (step_button(c, "result.look", compares ? "Compare with the model before" : "Look at it",
                    {.icon = compares ? icons::kCompare : icons::kFit,
                     .help = compares ? "Both models side by side" : "The whole model in view"}))
        c.core.get<ResultFeature>().look();
    if (step_button(c, "result.review", "Review it",
                    {.icon = icons::kCheck, .help = "Judge the edits, one after the other"}))
        return c.core.choose_step(Step::Review);  // which closes the card
    if (step_button(c, "result.export", "Export it",
                    {.icon = icons::kExport,
                     .primary = true,
                     .enabled = c.core.document.can(RequestKind::Output),
                     .help = "Write the model to a file"}))
        c.core.ask(FileQuestion::Export);
}

}  // namespace

void draw_result_card(PanelContext& c, const ScreenRect& rect) {
    const ResultCard card = *c.core.get<ResultFeature>().card();
    begin_frame(c.ui, "result", rect, {});
    draw_head(c, card);
    for (const ResultRow& figure : card.rows) draw_figure(c.ui, figure);
    space(c.ui, 1.5F);
    draw_next(c, card);
    end_frame();
}

}  // namespace vesselbench
