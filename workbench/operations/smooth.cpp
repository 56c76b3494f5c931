#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/freed_memory.h"
#include "geometry/kernel/unsmoothed.h"
#include "geometry/kernel/wording.h"
#include "smoothing/filters/new_crossings.h"
#include "workbench/case/measure_json.h"
#include "workbench/operations/shared/context_weights.h"
#include "workbench/operations/shared/crossing_warning.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/smooth/change_meter.h"
#include "workbench/operations/smooth/context.h"
#include "workbench/operations/smooth/context_filter.h"
#include "workbench/operations/smooth/filter_choice.h"
#include "workbench/operations/smooth/kept_attributes.h"
#include "workbench/operations/smooth/search.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Adds the figures of the change beside those that every edit has. \return the local error
LocalError add_changes(Json& report, const Surface& before, const Surface& after) {
    SmoothingChange change = ChangeMeter(before).measure(after);
    report["volume_change_percent"] = change.volume_change_percent;
    report["vertices"] = before.vertex_count();
    report["local_error"] = distance_json(change.error.mean, change.error.largest);
    report["normal_curvature_before_deg"] = change.normal_curvature_before_deg;
    report["normal_curvature_after_deg"] = change.normal_curvature_after_deg;
    return std::move(change.error);
}

bool any_moved(const Positions& before, const Positions& after) {
    for (std::size_t v = 0; v < before.size(); ++v)
        if ((after[v] - before[v]).norm() > 0.0) return true;
    return false;
}

constexpr double kNextToNothing = 0.02;  // mean weight below which a run hardly has an effect

/// The weights that hold a run back nearly everywhere; none if none do.
std::optional<Diagnostic> what_holds_back(const ContextFigures& figures) {
    if (!figures.mean_weight || *figures.mean_weight >= kNextToNothing) return std::nullopt;
    Diagnostic warning{.code = "weights-hold-back", .figures = {{"weight", *figures.mean_weight}}};
    const auto add = [&](const char* name, const std::optional<double>& weight) {
        if (weight) warning.figures[name] = *weight;
    };
    add("staircase_weight", figures.mean_weight_staircase);
    add("distance_weight", figures.mean_weight_distance);
    add("painted_weight", figures.mean_weight_painted);
    return warning;
}

/// Share of vertices on staircases below which a surface shows none [-].
constexpr double kHardlyAny = 0.001;

/// What becomes of a smoothing aware of staircases on a surface that shows none; none if it does.
std::optional<Diagnostic> without_staircases(const ContextFigures& figures,
                                             const Arguments& resolved, std::size_t vertices) {
    const auto found = figures.staircase_vertices;
    const auto all = static_cast<double>(vertices);
    if (!found || static_cast<double>(*found) >= kHardlyAny * all) return std::nullopt;
    return Diagnostic{
        .code = "hardly-any-staircases",
        .figures = {{"found", static_cast<double>(*found)},
                    {"vertices", all},
                    {"tau_theta", resolved.real("tau_theta")},
                    {"beta_min", resolved.real("beta_min")}},
        .remedies = {{.arguments = {{"tau_theta", ""}}}, {.arguments = {{"staircase", "false"}}}}};
}

/// Why nothing moved.
Diagnostic nothing_moved(const ContextFigures& figures, const Arguments& resolved) {
    Diagnostic reason = why_all_is_kept(figures, resolved).value_or(Diagnostic{.code = "all-kept"});
    if (resolved.flag("staircase") && figures.staircase_vertices == 0)
        reason.remedies.push_back({.arguments = {{"beta_min", ""}}});
    reason.words["why"] = text_of(reason);
    reason.code = "nothing-moved";
    return reason;
}

/// Why a filter that should have moved something moved nothing or almost nothing, or moved
/// everything alike although it looked for staircases.
std::optional<Diagnostic> why_little_moved(const ContextFigures& figures, const Arguments& resolved,
                                           std::size_t vertices, bool moved) {
    if (resolved.integer("iterations") == 0 || resolved.real("lambda") == 0.0) return std::nullopt;
    if (!moved) return nothing_moved(figures, resolved);
    auto found = without_staircases(figures, resolved, vertices);
    return found ? found : what_holds_back(figures);
}

class LiveSmoothing final : public ReplacingStepper {
public:
    LiveSmoothing(const Scene& scene, const Arguments& arguments, Progress& progress)
        : ReplacingStepper(arguments), before_(scene), filter_(scene) {
        use(arguments, progress);
    }

    [[nodiscard]] const Scene& scene() const override { return bare_.scene; }

    [[nodiscard]] const Arguments& resolved() const override { return bare_.resolved; }

    [[nodiscard]] Outcome outcome(Progress& progress) override {
        progress.report(0.0, "measuring");
        Outcome outcome = bare_;
        const Surface &before = surface_of(before_), &after = surface_of(outcome.scene);
        Json report = {{"caps", figures_.caps}, {"cap_vertices_kept", figures_.cap_vertices_kept}};
        report.update(context_json(figures_.weights));
        if (outcome.resolved.text("distance") != "none")
            report["smallest_neighbour_distance_after_mm"] =
                smallest_neighbour_distance(before_, outcome.resolved, "smooth", after.points());
        LocalError error = add_changes(report, before, after);
        if (auto reason =
                why_little_moved(figures_.weights, outcome.resolved, before.vertex_count(),
                                 any_moved(before.points(), after.points())))
            outcome.warnings.push_back(std::move(*reason));
        if (outcome.resolved.flag("keep_weights"))
            outcome.scene = with_surface(
                outcome.scene,
                with_kept_attributes(before_, after, outcome.resolved, std::move(error.values)));
        if (outcome.resolved.flag("keep_unsmoothed"))
            outcome.scene = with_surface(
                outcome.scene, with_unsmoothed(surface_of(outcome.scene), before.points()));
        outcome.report = std::make_shared<Json>(std::move(report));
        return outcome;
    }

private:
    void use(const Arguments& arguments, Progress& progress) override {
        const Surface& surface = surface_of(before_);
        Outcome bare;
        bare.resolved = arguments;
        resolve_filter(before_, bare.resolved);
        if (auto warning = filter_warning(filter_from(bare.resolved)))
            bare.warnings.push_back(std::move(*warning));
        auto [moved, resolved, figures, reason, device] =
            filter_.run(bare.resolved, progress.part(0.0, 0.8));
        bare.device = std::move(device);
        bare.resolved = std::move(resolved);
        if (!reason.empty())
            bare.warnings.push_back({.code = "gpu-not-used", .words = {{"reason", reason}}});
        release_freed_memory();
        // No filter may make the surface pass through itself.
        warn_of_crossings(take_back_crossings(surface, moved, progress.part(0.8, 1.0)),
                          "filter-crosses-walls",
                          {{.arguments = {{"iterations", ""}}}, {.operation = "repair"}}, bare);
        bare.scene = with_surface(before_, surface.with_positions(std::move(moved)));
        bare_ = std::move(bare);
        figures_ = std::move(figures);
    }

    Scene before_;
    ContextFilter filter_;
    Outcome bare_;  ///< without a report
    SmoothingFigures figures_;
};

/// A worker has neither the address space nor the time that a GPU's driver needs.
bool asks_for_gpu(const Arguments& arguments) {
    return device_choice_from(arguments.text("device")) == DeviceChoice::Gpu;
}

Arguments decided_smoothing(const Scene& scene, const CheckedArguments& arguments,
                            const Progress&) {
    Arguments decided = arguments;
    resolve_filter(scene, decided);
    decide_context(scene, *make_cpu_finder(surface_of(scene)), decided);
    decided.remove("device");  // a run finds out whether there is one
    return decided;
}

/// As the default recipe smooths a surface whose voxels are known.
Arguments suggested_arguments(const Scene& scene, const std::string& variant) {
    if (!scene.sampling || scene.sampling->confidence <= 0.0 || !is_preset(variant)) return {};
    return {{"preset", variant}, {"staircase", variant != "simulation"}};
}

std::vector<Parameter> parameter_table() {
    std::vector<Parameter> table = filter_parameter_table();
    for (Parameter& parameter : context_parameter_table()) table.push_back(std::move(parameter));
    table.push_back(
        {.name = "keep_weights",
         .type = ParameterType::Flag,
         .default_value = false,
         .help = "add vertex attributes to the surface: smoothing_weight, staircase_weight, "
                 "staircase, cap, neighbour_distance, local_error, mean_curvature; VTP and "
                 "PLY files keep them, and pictures can show them",
         .use = Use::Rare});
    table.push_back(
        {.name = "keep_unsmoothed",
         .type = ParameterType::Flag,
         .default_value = false,
         .help = "add vertex attributes to the surface: unsmoothed_x, unsmoothed_y and "
                 "unsmoothed_z, the places before; on coarse triangles, the directions of vessels "
                 "are measured there, and they are dropped when all ends have been opened",
         .use = Use::Rare});
    table.push_back(
        {.name = "device",
         .type = ParameterType::Choice,
         .default_value = std::string("auto"),
         .help = "device that finds the context and moves the vertices: auto and cpu give the same "
                 "bits everywhere; gpu is faster on large surfaces, is replayed by tolerance, and "
                 "falls back to the CPU without a usable GPU",
         .choices = {"auto", "cpu", "gpu"},
         .use = Use::Rare});
    return table;
}

}  // namespace

Operation smooth_operation() {
    return {.name = "smooth",
            .usual_step = Step::Smoothing,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary = "smooth the surface, aware of staircases, neighbours and caps",
            .parameters = parameter_table(),
            .start = &started<LiveSmoothing>,
            .stays_here = &asks_for_gpu,
            .suggested = &suggested_arguments,
            .decided = &decided_smoothing,
            .may_change = &moved_vertices,
            .thesis = "3.3.4, 5",
            .recipe = {.volume_remedies = {{.arguments = {{"iterations", ""}}},
                                           {.arguments = {{"filter", "taubin"}}}}},
            .search = {.smoothing = &smoothing_subject,
                       .filter_parameter = "filter",
                       .hint = "staircase=true keeps its thresholds, beta_min and alpha"},
            .example = {.changed = {{"filter", std::string("taubin")}}}};
}

}  // namespace vesselbench
