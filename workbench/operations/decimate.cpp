#include "meshing/remeshing/decimate.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/triangle_shape.h"
#include "geometry/kernel/wording.h"
#include "smoothing/context/caps.h"
#include "workbench/case/measure_json.h"
#include "workbench/operations/shared/context_weights.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kUsualShare = 0.5;

/// The arguments' target; half of the triangles if they name none.
DecimateParameters target_from(const Surface& surface, Arguments& arguments) {
    const bool counted = arguments.has("triangles");
    if (arguments.has("share") && counted)
        throw UsageError("decimate: share and triangles exclude each other: give one of them");
    if (!arguments.has("share") && !counted && !arguments.has("max_error"))
        arguments.set("share", kUsualShare);
    DecimateParameters target{.max_error = arguments.optional_real("max_error")};
    if (counted) target.triangles = static_cast<std::size_t>(arguments.integer("triangles"));
    if (const auto share = arguments.optional_real("share"))
        target.triangles = static_cast<std::size_t>(
            std::max(1.0, std::round(*share * static_cast<double>(surface.triangle_count()))));
    return target;
}

ContextWeights weights_from(const Scene& scene, Arguments& arguments) {
    const Surface& surface = surface_of(scene);
    const auto finder = make_cpu_finder(surface);
    WeightSettings settings{.operation = "decimate", .beta_min = arguments.real("beta_min")};
    if (arguments.flag("staircase")) {
        settings.cap_weight =
            settings.beta_min;  // a flat end is neither a staircase nor to be preserved
        settings.caps = cap_vertices(finder->caps(), surface.vertex_count());
    }
    return context_weights(scene, settings, *finder, arguments);
}

void add_changes(Json& report, const Surface& before, const Surface& after,
                 const Progress& progress) {
    const ReferenceComparison found = compare_with_reference(after, before, progress);
    report["distance"] = distance_json(found.mean_distance, found.hausdorff);
    report["shape_before"] = triangle_shape_json(triangle_shape(before));
    report["shape_after"] = triangle_shape_json(triangle_shape(after));
}

/// The same parts for any beta_min: 1 at the largest weight, 0 at the smallest.
std::vector<double> stretched(std::vector<double> weights) {
    const auto [least, largest] = std::ranges::minmax(weights);
    if (!(largest > least)) return weights;
    for (double& weight : weights) weight = (weight - least) / (largest - least);
    return weights;
}

/// What the weights gain: distances of the result, and of as many triangles without weights.
struct Gain {
    WeighedComparison weighted;
    WeighedComparison unweighted;
    std::size_t unweighted_triangles = 0;
};

Gain gain_of(const Surface& before, const Surface& after, const std::vector<double>& weights,
             const Progress& progress) {
    const std::vector<double> parts = stretched(weights);
    progress.report(0.0, "decimating without weights, for comparison");
    const Decimated plain = decimate(before, {.triangles = after.triangle_count()}, {}, progress);
    return {compare_by_weight(after, before, parts, progress),
            compare_by_weight(plain.surface, before, parts, progress),
            plain.surface.triangle_count()};
}

/// Distances where the stretched weight is above one half (inside) and elsewhere.
Json parts_json(const WeighedComparison& found) {
    return {{"distance_inside", distance_json(found.inside.mean, found.inside.largest)},
            {"distance_outside", distance_json(found.outside.mean, found.outside.largest)}};
}

void add_gain(Json& report, const Gain& gain) {
    report.update(parts_json(gain.weighted));
    report["unweighted"] = {{"triangles", gain.unweighted_triangles}};
    report["unweighted"].update(parts_json(gain.unweighted));
}

/// A warning whose reason is another diagnostic.
Diagnostic because(const char* code, const Diagnostic& reason) {
    Diagnostic warning = reason;
    warning.words["why"] = text_of(reason);
    warning.code = code;
    return warning;
}

/// How the weights explain a result with as many triangles as before.
Diagnostic why_nothing_went(const ContextFigures& context, const Arguments& resolved) {
    if (auto reason = why_all_is_kept(context, resolved)) return *reason;
    if (context.mean_weight) return {.code = "no-triangle-free"};
    return {.code = "no-edge-collapses", .remedies = {{.arguments = {{"max_error", ""}}}}};
}

/// Of a target that could not be reached.
Diagnostic too_many_left(const DecimateReport& figures, std::size_t wanted) {
    Diagnostic warning{.code = "fewer-would-fold",
                       .figures = {{"triangles", static_cast<double>(figures.triangles_after)},
                                   {"wanted", static_cast<double>(wanted)}}};
    if (figures.vertices_locked == 0) return warning;
    warning.code = "fewer-would-cross";
    warning.figures["locked"] = static_cast<double>(figures.vertices_locked);
    return warning;
}

void warn(const DecimateReport& figures, const DecimateParameters& target,
          const ContextFigures& context, Outcome& outcome) {
    const auto add = [&](Diagnostic warning) { outcome.warnings.push_back(std::move(warning)); };
    const bool idle = target.triangles && *target.triangles >= figures.triangles_before;
    const bool nothing_went = figures.triangles_after == figures.triangles_before;
    if (idle)
        add({.code = "nothing-to-decimate",
             .figures = {{"triangles", static_cast<double>(*target.triangles)}}});
    else if (nothing_went && target.max_error)
        add(because("all-triangles-kept", why_nothing_went(context, outcome.resolved)));
    else if (context.staircase_vertices == 0)
        if (const auto reason = why_all_is_kept(context, outcome.resolved))
            add(because("no-staircases", *reason));
    if (!figures.target_reached && !target.max_error)
        add(too_many_left(figures, *target.triangles));
    if (figures.kept_vertices_lost > 0)
        add({.code = "kept-vertices-lost",
             .figures = {{"vertices", static_cast<double>(figures.kept_vertices_lost)}}});
    if (figures.crossings_left > 0)
        add({.code = "decimation-crosses-walls",
             .place = figures.crossing,
             .figures = {{"crossings", static_cast<double>(figures.crossings_left)}}});
}

/// Warns if decimation without weights preserves the kept part better.
void warn_of_loss(const Gain& gain, Outcome& outcome) {
    const double with = gain.weighted.outside.mean, without = gain.unweighted.outside.mean;
    constexpr double kNoticeable = 1.05;
    if (with <= kNoticeable * without) return;
    outcome.warnings.push_back(
        {.code = "weights-gain-nothing", .figures = {{"with_mm", with}, {"without_mm", without}}});
}

/// The operation's inputs from the scene, before figures are added.
struct Run {
    Outcome outcome;
    DecimateParameters target;
    ContextWeights context;
    DecimateReport decimated;
};

Run decimated_by(const Scene& scene, const Arguments& arguments, const Progress& progress) {
    const Surface& before = surface_of(scene);
    Run run;
    run.outcome.resolved = arguments;
    run.target = target_from(before, run.outcome.resolved);
    progress.report(0.0, "finding the context");
    run.context = weights_from(scene, run.outcome.resolved);
    Decimated decimated =
        decimate(before, run.target, run.context.weights, progress.part(0.2, 1.0));
    run.decimated = decimated.report;
    run.outcome.scene = with_surface(scene, std::move(decimated.surface));
    return run;
}

class LiveDecimation final : public ReplacingStepper {
public:
    LiveDecimation(const Scene& scene, const Arguments& arguments, Progress& progress)
        : ReplacingStepper(arguments),
          before_(scene),
          run_(decimated_by(scene, arguments, progress)) {}

    [[nodiscard]] const Scene& scene() const override { return run_.outcome.scene; }

    [[nodiscard]] const Arguments& resolved() const override { return run_.outcome.resolved; }

    [[nodiscard]] Outcome outcome(Progress& progress) override {
        Outcome outcome = run_.outcome;
        const ContextWeights& context = run_.context;
        Json report = context_json(context.figures);
        const Surface &before = surface_of(before_), &after = surface_of(outcome.scene);
        add_changes(report, before, after, progress);
        warn(run_.decimated, run_.target, context.figures, outcome);
        if (!context.weights.empty()) {
            const Gain gain = gain_of(before, after, context.weights, progress.part(0.2, 0.8));
            add_gain(report, gain);
            warn_of_loss(gain, outcome);
        }
        outcome.report = std::make_shared<Json>(std::move(report));
        return outcome;
    }

private:
    void use(const Arguments& arguments, Progress& progress) override {
        run_ = decimated_by(before_, arguments, progress);
    }

    Scene before_;
    Run run_;
};

Arguments decided_decimation(const Scene& scene, const CheckedArguments& arguments,
                             const Progress&) {
    Arguments decided = arguments;
    const Surface& surface = surface_of(scene);
    static_cast<void>(target_from(surface, decided));
    decide_weights(scene, "decimate", *make_cpu_finder(surface), decided);
    return decided;
}

/// The share that max_error alone has left.
double share_left(const Surface& before, const Surface& after) {
    return static_cast<double>(after.triangle_count()) /
           static_cast<double>(before.triangle_count());
}

std::vector<SearchedParameter> searched_parameters(const Surface&, bool) {
    SearchedParameter share{
        .name = "share", .values = {0.02}, .coarse = 4, .idle = 1.0, .value_if_open = &share_left};
    for (int twentieths = 1; twentieths <= 20; ++twentieths)
        share.values.push_back(twentieths / 20.0);
    return {share};
}

std::vector<Parameter> parameter_table() {
    std::vector<Parameter> table = {
        {.name = "share",
         .unit = "-",
         .help = "fraction of the triangles to keep; default 0.5, unless triangles or max_error is "
                 "given",
         .minimum = 0.0,
         .maximum = 1.0,
         .above_minimum = true},
        {.name = "triangles",
         .type = ParameterType::Integer,
         .help = "number of triangles to keep, instead of share",
         .minimum = 4},
        {.name = "max_error",
         .unit = "mm",
         .help = "largest distance from the original surface; alone, or as a limit before share or "
                 "triangles is reached. Where the weight is smaller, the limit is smaller in "
                 "proportion",
         .minimum = 0.0,
         .above_minimum = true}};
    const WeighedAction action{.doing = "decimation",
                               .staircase_help =
                                   "decimate the staircases of the image's slices first, which are "
                                   "inaccurate anyway, fading out around them",
                               .kept = "are decimated last, and not at all with max_error",
                               .painted_one = "like all others"};
    const auto add = [&](const std::vector<Parameter>& more) {
        table.insert(table.end(), more.begin(), more.end());
    };
    add(staircase_parameter_table(action));
    add({{.name = "beta_min",
          .unit = "-",
          .default_value = 0.3,
          .help = "fraction of the staircases' error [mm] allowed elsewhere: near 0 the rest is "
                  "kept as long as that ruins no staircase, 1 decimates it like staircases",
          .minimum = 0.0,
          .maximum = 1.0,
          .only_with = Condition{"staircase", {"true"}}}});
    add(distance_parameter_table(action));
    return table;
}

}  // namespace

Operation decimate_operation() {
    return {.name = "decimate",
            .usual_step = Step::Remeshing,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary =
                "reduce the number of triangles, most where the context allows it; rims, flat caps "
                "and patches are kept",
            .parameters = parameter_table(),
            .start = &started<LiveDecimation>,
            .decided = &decided_decimation,
            .may_change = &kept_vessels_and_sacs,
            .thesis = "5.6, 7.2",
            .search = {.parameters = &searched_parameters,
                       .rivals = {"triangles"},
                       .counts_triangles = true,
                       .strong_is_first = true},
            .example = {.changed = {{"share", 0.4}}}};
}

}  // namespace vesselbench
