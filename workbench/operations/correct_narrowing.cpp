#include "geometry/vessel/narrowing/correct_narrowing.h"

#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/narrowing/image_evidence.h"
#include "geometry/vessel/narrowing/named_narrowing.h"
#include "workbench/case/point_json.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/shared/narrowing_evidence.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

NarrowingQuestion question_of(const Scene& scene, const Arguments& arguments) {
    NarrowingQuestion question{.at = arguments.point("at"),
                               .from = arguments.optional_point("from"),
                               .to = arguments.optional_point("to")};
    if (scene.sampling) question.parameters.resolution = scene.sampling->spacing.maxCoeff();
    return question;
}

/// What a run stores: the stretch and the radius, so that a replay widens the same.
void set_decisions(Arguments& arguments, const NamedNarrowing& named) {
    arguments.set("from", named.from);
    arguments.set("to", named.to);
    if (!arguments.has("radius")) arguments.set("radius", named.narrowing.expected_radius);
}

Arguments decided(const Scene& scene, const CheckedArguments& arguments, const Progress& progress) {
    Arguments found = arguments;
    set_decisions(found, narrowing_at(surface_of(scene), question_of(scene, arguments), progress));
    return found;
}

Json evidence_json(const std::optional<ImageEvidence>& evidence) {
    if (!evidence) return nullptr;
    return {{"verdict", to_string(evidence->verdict)},
            {"core_contrast", evidence->core_contrast},
            {"integral", evidence->integral},
            {"edge_radius_mm", evidence->edge_radius},
            {"lumen_radius_mm", evidence->lumen_radius},
            {"lumen_contrast", evidence->lumen_contrast},
            {"misfit_falls", evidence->misfit_falls},
            {"misfit_agrees", evidence->misfit_agrees}};
}

/// What speaks against the correction.
void warn(const std::optional<ImageEvidence>& evidence, const Narrowing& narrowing,
          Outcome& outcome) {
    if (!evidence || evidence->verdict == ImageVerdict::ContrastFalls) return;
    const bool agrees = evidence->verdict == ImageVerdict::ImageAgrees;
    outcome.warnings.push_back(
        {.code = agrees ? "image-shows-narrowing" : "image-undecided-on-narrowing",
         .place = narrowing.place,
         .figures = {{"lumen_mm", evidence->lumen_radius},
                     {"expected_mm", narrowing.expected_radius},
                     {"core_percent", 100.0 * evidence->core_contrast}}});
}

Outcome run(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    const NamedNarrowing named =
        narrowing_at(surface, question_of(scene, arguments), progress.part(0.0, 0.7));
    Outcome outcome;
    outcome.resolved = arguments;
    set_decisions(outcome.resolved, named);
    const CorrectedNarrowing corrected =
        correct_narrowing(surface, *named.graph, named.rings, named.narrowing,
                          {.strength = arguments.real("strength"),
                           .radius = arguments.optional_real("radius"),
                           .blend = arguments.real("blend")},
                          progress.part(0.7, 1.0));
    const auto evidence = narrowing_evidence(scene, named.rings, named.narrowing);
    warn(evidence, named.narrowing, outcome);
    const Narrowing& narrowing = named.narrowing;
    outcome.report = std::make_shared<Json>(Json{{"place_mm", point_json(narrowing.place)},
                                                 {"expected_radius_mm", narrowing.expected_radius},
                                                 {"found_radius_mm", narrowing.found_radius},
                                                 {"radius_mm", corrected.radius},
                                                 {"length_mm", narrowing.to - narrowing.from},
                                                 {"length_moved_mm", corrected.to - corrected.from},
                                                 {"certainty", narrowing.certainty},
                                                 {"moved_vertices", corrected.moved},
                                                 {"largest_mm", corrected.farthest},
                                                 {"image", evidence_json(evidence)}});
    outcome.scene = with_surface(scene, corrected.surface);
    return outcome;
}

constexpr double kAround = 4.0;  ///< wall of a section lies this near its axis [radii]

StatedChange widened_stretch(const Scene&, const Outcome& outcome) {
    const Json& figures = *outcome.report;
    const double radius = std::max(figures.at("radius_mm").get<double>(),
                                   figures.at("expected_radius_mm").get<double>());
    const ChangeZone zone{point_from(figures.at("place_mm")),
                          figures.at("length_moved_mm").get<double>() + kAround * radius};
    return {.zones = {{zone}}, .keeps_triangles = true, .keeps_walls_apart = true};
}

}  // namespace

Operation correct_narrowing_operation() {
    using enum ParameterType;
    return {
        .name = "correct-narrowing",
        .usual_step = Step::LocalRepair,
        .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                    Step::Smoothing, Step::Deformation},
        .summary = "widen a vessel where it is narrower than beside it; sections keep their shape",
        .parameters =
            {{.name = "at",
              .type = Point,
              .unit = "mm",
              .help = "a point at the narrowing, on the wall or inside",
              .required = true,
              .meaning = Meaning::Place},
             {.name = "strength",
              .unit = "-",
              .default_value = 1.0,
              .help = "1 widens to the radius, 0.5 halfway",
              .minimum = 0.0,
              .maximum = 1.0},
             {.name = "radius",
              .unit = "mm",
              .help = "of the vessel where it is narrowest, elsewhere in proportion; default: "
                      "what the vessel beside the narrowing lets expect",
              .minimum = 0.0,
              .above_minimum = true},
             {.name = "blend",
              .unit = "-",
              .default_value = 1.0,
              .help = "length on each side over which the widening fades out, in radii",
              .minimum = 0.25,
              .maximum = 10.0},
             {.name = "from",
              .type = Point,
              .unit = "mm",
              .help = "one end of the stretch, near the vessel's axis; default: where the "
                      "narrowing ends",
              .meaning = Meaning::Place,
              .use = Use::Rare},
             {.name = "to",
              .type = Point,
              .unit = "mm",
              .help = "the stretch's other end; default: where the narrowing ends",
              .meaning = Meaning::Place,
              .use = Use::Rare}},
        .run = &run,
        .decided = &decided,
        .may_change = &widened_stretch,
        .thesis = "4.2.4",
        .example = {
            .placed = {"from", "to"}, .given = {{"radius", 1.1}}, .changed = {{"strength", 0.5}}}};
}

}  // namespace vesselbench
