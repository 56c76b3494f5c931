#include "workbench/window/features/findings/findings_panel.h"

#include <imgui.h>

#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/findings/findings_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kTitle = 12.0F;    ///< [em]
constexpr float kButtons = 19.0F;  ///< room for those of a row [em]

std::string certainty_text(const Finding& finding) {
    return formatted(100.0 * finding.certainty, "%.0f %% sure");
}

std::string treatment_help(const Finding& finding) {
    const Remedy* treatment = finding.treatment();
    if (treatment == nullptr) return "No operation treats this by itself";
    std::string words = readable(treatment->operation);
    for (const auto& [name, value] : treatment->arguments)
        words += ", " + readable(name) + " " + value;
    return words;
}

void draw_buttons(PanelContext& c, FindingsFeature& feature, const Finding& finding,
                  std::size_t i) {
    const std::string number = std::to_string(i), help = treatment_help(finding);
    const bool treatable = finding.treatment() != nullptr && c.core.document.can(RequestKind::Edit);
    if (button(c.ui, "findings.accept." + number, "Accept",
               {.enabled = treatable, .help = "Run at once: " + help}))
        feature.accept(i);
    ImGui::SameLine(0, c.ui.grid(0.5F));
    if (button(c.ui, "findings.change." + number, "Change",
               {.enabled = treatable, .help = "Open the form: " + help}))
        feature.change(i);
    ImGui::SameLine(0, c.ui.grid(0.5F));
    if (button(c.ui, "findings.dismiss." + number, "Dismiss",
               {.enabled = c.core.document.snapshot()->read_only_reason.empty(),
                .help = "This is no artefact: say why"}))
        feature.ask_reason(i);
}

void draw_reason(PanelContext& c, FindingsFeature& feature) {
    ImGui::SetCursorPosX(c.ui.grid(6));
    const float field = ImGui::GetContentRegionAvail().x - c.ui.em * 8;
    text_field(c.ui, "findings.reason", feature.reason,
               {.hint = "why it is no artefact; the reason stays in the project", .width = field});
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "findings.confirm", "Dismiss",
               {.primary = true, .enabled = !feature.reason.empty()}))
        feature.dismiss_asked();
}

void draw_finding(PanelContext& c, FindingsFeature& feature, std::size_t i) {
    const Finding& finding = feature.findings()->open[i];
    const Ui& ui = c.ui;
    const float right = ImGui::GetWindowWidth() - ui.em * kButtons;
    const bool current = feature.at() == i;
    ImGui::SetCursorPosX(ui.grid(1));
    if (icon_button(c.ui, "findings.look." + std::to_string(i), icons::kTarget,
                    "Show the place in the view and in the slices", true, current))
        feature.look_at(i);
    const float title = ui.grid(6), evidence = title + ui.em * kTitle;
    ImGui::SameLine(title);
    ImGui::AlignTextToFramePadding();
    clipped_text(ui, title_of_kind(finding.kind) + ", " + certainty_text(finding),
                 current ? ui.theme.accent : ui.theme.text, ui.em * kTitle - ui.grid(1));
    ImGui::SameLine(evidence);
    ImGui::AlignTextToFramePadding();
    clipped_text(ui, readable_sentence(worded(finding.evidence, {.window = true})), ui.theme.muted,
                 right - evidence - ui.grid(1));
    ImGui::SameLine(right);
    draw_buttons(c, feature, finding, i);
    if (feature.asked() == i) draw_reason(c, feature);
}

void draw_dismissed(const PanelContext& c, const JudgedFindings& findings) {
    for (const auto& [dismissal, finding] : findings.dismissed)
        wrapped(c.ui,
                "Dismissed: " + title_of_kind(dismissal.kind) +
                    (finding ? "" : ", no longer found") + " (" + printable(dismissal.author) +
                    "): " + printable(dismissal.reason),
                c.ui.theme.muted);
}

}  // namespace

void draw_findings(PanelContext& c) {
    auto& feature = c.core.get<FindingsFeature>();
    space(c.ui, 0.5F);
    feature.want();
    if (!feature.problem().empty()) return wrapped(c.ui, feature.problem(), c.ui.theme.warning);
    if (!feature.findings())
        return wrapped(
            c.ui,
            feature.is_searching() ? "Looking for artefacts..." : "There is no surface to look at.",
            c.ui.theme.muted);
    if (feature.findings()->open.empty())
        wrapped(c.ui, "Nothing on the model looks wrong.", c.ui.theme.muted);
    for (std::size_t i = 0; i < feature.findings()->open.size(); ++i) draw_finding(c, feature, i);
    draw_dismissed(c, *feature.findings());
    for (const std::string& line : not_searched_lines(feature.findings()->not_searched))
        wrapped(c.ui, readable_sentence(line), c.ui.theme.warning);
}

}  // namespace vesselbench
