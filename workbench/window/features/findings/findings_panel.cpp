#include "workbench/window/features/findings/findings_panel.h"

#include <imgui.h>

#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
#include "workbench/findings/question.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/findings/findings_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kTitle = 14.5F;    ///< [em]
constexpr float kButtons = 17.0F;  ///< room for those of a row [em]

/// Certainty and what was measured.
std::string evidence_text(const Finding& finding) {
    return certainty_words(finding) + ". " +
           readable_sentence(worded(finding.evidence, {.window = true}));
}

std::string treatment_help(const Finding& finding) {
    const Remedy* treatment = finding.treatment();
    if (treatment == nullptr) return "No operation treats this by itself";
    std::string words = readable(treatment->operation);
    for (const auto& [name, value] : treatment->arguments)
        words += ", " + readable(name) + " " + value;
    return words;
}

bool is_treatable(const PanelContext& c, const FindingsFeature& feature, std::size_t i) {
    return feature.findings()->open[i].treatment() != nullptr && feature.refusal(i) == nullptr &&
           c.core.document.can(RequestKind::Edit);
}

/// What may be anatomy is kept, or corrected after a look at the preview.
void draw_answers(PanelContext& c, FindingsFeature& feature, const Finding& finding,
                  std::size_t i) {
    const std::string number = std::to_string(i);
    if (button(c.ui, "findings.keep." + number, "Keep",
               {.primary = true,
                .enabled = c.core.document.snapshot()->read_only_reason.empty(),
                .help = "Leave it as it is; the project keeps who decided that"}))
        feature.keep(i);
    ImGui::SameLine(0, c.ui.grid(0.5F));
    if (button(c.ui, "findings.change." + number,
               "It is: " + artefact_reading(finding)->name + "...",
               {.enabled = is_treatable(c, feature, i),
                .help = "Open the form, with a preview: " + treatment_help(finding)}))
        feature.change(i);
}

void draw_corrections(PanelContext& c, FindingsFeature& feature, const Finding& finding,
                      std::size_t i) {
    const std::string number = std::to_string(i), help = treatment_help(finding);
    const bool treatable = is_treatable(c, feature, i);
    if (button(c.ui, "findings.apply." + number, "Apply correction",
               {.enabled = treatable, .help = "Run at once: " + help}))
        feature.treat_at_once(i);
    ImGui::SameLine(0, c.ui.grid(0.5F));
    if (button(c.ui, "findings.change." + number, "Change",
               {.enabled = treatable, .help = "Open the form: " + help}))
        feature.change(i);
    ImGui::SameLine(0, c.ui.grid(0.5F));
    if (button(c.ui, "findings.keep." + number, "Keep",
               {.enabled = c.core.document.snapshot()->read_only_reason.empty(),
                .help = "This is no artefact: say why"}))
        feature.keep(i);
}

void draw_reason(PanelContext& c, FindingsFeature& feature) {
    ImGui::SetCursorPosX(c.ui.grid(6));
    const float field = ImGui::GetContentRegionAvail().x - c.ui.em * 8;
    text_field(c.ui, "findings.reason", feature.reason,
               {.hint = "why it is no artefact; the reason stays in the project", .width = field});
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "findings.confirm", "Keep",
               {.primary = true, .enabled = !feature.reason.empty()}))
        feature.keep_asked();
}

void draw_readings(const PanelContext& c, const Finding& finding) {
    for (const Reading& reading : finding.readings) {
        ImGui::SetCursorPosX(c.ui.grid(6));
        clipped_text(c.ui, readable_sentence(reading_words(reading, true)), c.ui.theme.muted,
                     ImGui::GetContentRegionAvail().x - c.ui.grid(1));
    }
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
    clipped_text(ui, title_of(finding), current ? ui.theme.accent : ui.theme.text,
                 ui.em * kTitle - ui.grid(1));
    ImGui::SameLine(evidence);
    ImGui::AlignTextToFramePadding();
    clipped_text(ui, evidence_text(finding), ui.theme.muted, right - evidence - ui.grid(1));
    ImGui::SameLine(right);
    if (finding.asks())
        draw_answers(c, feature, finding, i);
    else
        draw_corrections(c, feature, finding, i);
    draw_readings(c, finding);
    if (const std::string* why = feature.refusal(i)) {
        ImGui::SetCursorPosX(ui.grid(6));
        clipped_text(ui, "Cannot be corrected: " + *why, ui.theme.warning,
                     ImGui::GetContentRegionAvail().x - ui.grid(1));
    }
    if (feature.asked() == i) draw_reason(c, feature);
}

/// The line under which the less certain ones are folded.
void draw_fold(PanelContext& c, FindingsFeature& feature) {
    const std::size_t likely = listed_count(feature.findings()->open);
    const std::size_t folded = feature.findings()->open.size() - likely;
    if (folded == 0) return;
    const bool open = feature.listed() > likely;
    ImGui::SetCursorPosX(c.ui.grid(1));
    if (button(c.ui, "findings.more",
               open ? "Fold those below 50 %" : folded_words(folded, likely > 0),
               {.icon = open ? icons::kUp : icons::kDown,
                .quiet = true,
                .help = "More often wrong than right: most are noise of the wall"}))
        feature.unfold(!open);
}

void draw_dismissed(const PanelContext& c, const JudgedFindings& findings) {
    for (const auto& [dismissal, finding] : findings.dismissed)
        wrapped(c.ui,
                "Kept: " + title_of_kind(dismissal.kind) + (finding ? "" : ", no longer found") +
                    " (" + printable(dismissal.author) + "): " + printable(dismissal.reason),
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
    for (std::size_t i = 0; i < feature.listed(); ++i) draw_finding(c, feature, i);
    draw_fold(c, feature);
    draw_dismissed(c, *feature.findings());
    for (const std::string& line : not_searched_lines(feature.findings()->not_searched))
        wrapped(c.ui, readable_sentence(line), c.ui.theme.warning);
}

}  // namespace vesselbench
