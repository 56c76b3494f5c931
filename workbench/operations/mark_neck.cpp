#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/sac/likely_sacs.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/shared/sac_figures.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// "12.3,4.5,6.7 (sac 64 %)" of each tip, the likeliest first.
std::string odds_text(const std::vector<JudgedTip>& tips) {
    std::vector<std::string> texts;
    for (const JudgedTip& tip : tips)
        texts.push_back(coordinates_argument(tip.tip) +
                        formatted(100.0 * tip.verdict.odds.sac, " (sac %.0f %%)"));
    return joined(texts, "; ");
}

/// The dome of the one sac that ends are likely to be.
Vec3 found_dome(const Scene& scene, const Progress& progress) {
    std::optional<ImageBox> image;
    if (scene.image)
        image =
            ImageBox{.size = scene.image->size, .index_to_patient = scene.image->index_to_patient};
    const std::vector<JudgedTip> tips =
        tips_by_sac_odds(surface_of(scene), image, progress.part(0.0, 0.5));
    const auto unlikely = std::ranges::find_if_not(tips, is_likely_sac);
    const std::vector<JudgedTip> likely(tips.begin(), unlikely);
    if (likely.size() == 1) return likely.front().tip;
    if (const auto dome = dome_of_one_sac(surface_of(scene), likely, progress.part(0.5, 1.0)))
        return *dome;
    Diagnostic refusal{.code = likely.empty() ? "no-sac-found" : "several-sacs",
                       .figures = {{"sacs", static_cast<double>(likely.size())}},
                       .remedies = {{.arguments = {{"dome", ""}}}}};
    if (!tips.empty()) refusal.words["ends"] = odds_text(tips);
    throw DiagnosedFailure(std::move(refusal));
}

/// What a run stores beside its arguments: the dome and the neck's plane.
Arguments with_neck(const Scene& scene, const Arguments& arguments, const Progress& progress) {
    if (arguments.has("at") != arguments.has("normal"))
        throw DiagnosedUsage(
            {.code = "neck-plane-incomplete",
             .remedies = {{.arguments = {{"at", ""}}}, {.arguments = {{"normal", ""}}}}});
    Arguments found = arguments;
    if (!found.has("dome")) found.set("dome", found_dome(scene, progress.part(0.0, 0.4)));
    if (found.has("at")) return found;
    const SacAtNeck proposed =
        propose_neck(surface_of(scene), found.point("dome"), progress.part(0.4, 1.0));
    found.set("at", proposed.sac.neck_centroid);
    found.set("normal", proposed.sac.neck.normal);
    return found;
}

Arguments decided(const Scene& scene, const CheckedArguments& arguments, const Progress& progress) {
    return with_neck(scene, arguments, progress);
}

std::string headline_of(const SacFigures& figures) {
    if (figures.in_doubt) return "the neck is in doubt";
    const SacMeasures& m = figures.measures;
    return formatted(m.neck_diameter, "neck %.1f mm, ") + formatted(m.height, "height %.1f mm, ") +
           formatted(m.aspect_ratio, "aspect ratio %.2f");
}

Outcome mark(const Scene& scene, const Arguments& arguments, Progress& progress) {
    Outcome outcome;
    outcome.scene = scene;
    outcome.resolved = with_neck(scene, arguments, progress.part(0.0, 0.8));
    const MarkedNeck marked = neck_in(outcome.resolved);
    const SacFigures figures =
        sac_figures(surface_of(scene), marked, Keys::WithUnits, progress.part(0.8, 1.0));
    if (figures.in_doubt) outcome.warnings.push_back(neck_in_doubt(marked, figures.measures));
    Json report = {{"headline", headline_of(figures)}};
    report.update(figures.table);
    outcome.report = std::make_shared<Json>(std::move(report));
    return outcome;
}

StatedChange nothing(const Scene&, const Outcome&) {
    return {.zones = std::vector<ChangeZone>(), .keeps_triangles = true};
}

std::vector<Parameter> neck_parameters() {
    using enum ParameterType;
    return {{.name = "dome",
             .type = Point,
             .unit = "mm",
             .help = "a point in the sac's dome, on the wall or inside; default: the one sac "
                     "that blind ends are likely to be",
             .meaning = Meaning::Tip},
            {.name = "at",
             .type = Point,
             .unit = "mm",
             .help = "a point of the neck's plane; default: the plane with the shortest outline "
                     "for the wall beyond it",
             .meaning = Meaning::Place},
            {.name = "normal",
             .type = Point,
             .unit = "-",
             .help = "direction perpendicular to the neck's plane, of any length and either sign; "
                     "given with a point of the plane",
             .meaning = Meaning::Neck},
            {.name = "reach",
             .unit = "-",
             .default_value = 1.0,
             .help = "distance from the neck up to which the parent and its daughters are regions, "
                     "in diameters of the parent",
             .minimum = 0.0,
             .maximum = 10.0,
             .above_minimum = true},
            {.name = "accept_doubt",
             .type = Flag,
             .default_value = false,
             .help = "give the sac's figures although the plane hardly is a neck's"}};
}

}  // namespace

Operation mark_neck_operation() {
    return {.name = "mark-neck",
            .usual_step = Step::Branches,
            .allowed = {Step::Branches, Step::LocalRepair, Step::Openings, Step::Smoothing,
                        Step::Deformation, Step::Remeshing, Step::Product},
            .summary = "mark an aneurysm's neck by a plane and measure the sac; nothing moves",
            .parameters = neck_parameters(),
            .run = &mark,
            .decided = &decided,
            .may_change = &nothing,
            .recipe = {.report_section =
                           ReportSection{.key = "sac",
                                         .title = "Sac",
                                         .about = "The aneurysm beyond its marked neck, measured "
                                                  "on this model."}},
            .example = {
                .scene = ExampleScene::Branches, .placed = {"dome"}, .changed = {{"reach", 1.5}}}};
}

}  // namespace vesselbench
