#include "smoothing/brush/brush.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/operations/brush/dabs.h"
#include "workbench/operations/crossing_warning.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// A negative strength deflates and takes weight away; there is no negative smoothing.
constexpr double kWeakest = -1.0, kSmoothWeakest = 0.0;

/// Runs the stroke of the arguments.
/// \param outcome gets the resolved arguments, warnings, and the number of dabs in its report
BrushStroke painted(const DabUse& use, const Surface& surface, const BrushSettings& settings,
                    Outcome& outcome, const Progress& progress) {
    const auto places = std::make_shared<const SurfaceDistance>(distance_to(surface));
    const auto dabs = resolved_dabs(use, surface, *places, outcome);
    BrushStroke stroke(surface, settings, places);
    std::size_t empty = 0;  // that changed no vertex
    for (std::size_t i = 0; i < dabs.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(dabs.size()), "brushing");
        try {
            if (stroke.add(dabs[i]).empty()) ++empty;
        } catch (const AlgorithmFailure& failure) {
            throw AlgorithmFailure(dab_name(use.operation, i, dabs[i]) + ": " + failure.what());
        }
    }
    if (empty > 0)
        outcome.warnings.push_back(
            counted(empty, "dab") +
            " changed nothing: strength 0, a radius below the triangles' size, or a cap");
    outcome.report = std::make_shared<ordered_json>(ordered_json{{"dabs", dabs.size()}});
    return stroke;
}

/// By how much a surface grew whose boundary, if any, stayed [mm^3].
double volume_change(const Surface& before, const Surface& after) {
    const Vec3 origin = before.points().front();
    const auto six_fold = [&](const Positions& x, const Triangle& t) {
        return (x[t[0]] - origin).dot((x[t[1]] - origin).cross(x[t[2]] - origin));
    };
    double sum = 0.0;
    for (const Triangle& t : before.triangles())
        sum += six_fold(after.points(), t) - six_fold(before.points(), t);
    return sum / 6.0;
}

/// \param outcome its report is completed
void add_changes(const Surface& before, const Surface& after, Outcome& outcome) {
    std::size_t count = 0;
    double largest = 0.0;
    for (std::size_t v = 0; v < before.vertex_count(); ++v) {
        if (after.points()[v] == before.points()[v]) continue;
        ++count;
        largest = std::max(largest, (after.points()[v] - before.points()[v]).norm());
    }
    ordered_json report = *outcome.report;
    report["vertices_moved"] = count;
    report["largest_displacement_mm"] = largest;
    report["volume_change_mm3"] = volume_change(before, after);
    outcome.report = std::make_shared<ordered_json>(std::move(report));
}

Outcome moved(const DabUse& use, const Scene& scene, const Arguments& arguments,
              const BrushSettings& settings, const Progress& progress) {
    const Surface& surface = surface_of(scene);
    Outcome outcome;
    outcome.resolved = arguments;
    BrushStroke stroke = painted(use, surface, settings, outcome, progress.part(0.0, 0.7));
    warn_of_crossings(stroke.keep_walls_apart(progress.part(0.7, 1.0)), "brush",
                      "undo, and brush with less strength", outcome);
    Surface after = stroke.surface();
    add_changes(surface, after, outcome);
    outcome.scene = with_surface(scene, std::move(after));
    return outcome;
}

Outcome brush_smooth(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const BrushSettings settings{.kind = BrushKind::Smooth,
                                 .passes = static_cast<int>(arguments.integer("passes"))};
    return moved({"brush-smooth", kSmoothWeakest}, scene, arguments, settings, progress);
}

Outcome brush_inflate(const Scene& scene, const Arguments& arguments, Progress& progress) {
    return moved({"brush-inflate", kWeakest}, scene, arguments, {.kind = BrushKind::Inflate},
                 progress);
}

/// Letters, digits and underscores: a name that every file format takes.
void check_attribute(const std::string& name) {
    const bool fits = name.size() > 1 && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                      std::ranges::all_of(name, [](unsigned char c) {
                          return (std::isalnum(c) != 0 && c < 128) || c == '_';
                      });
    if (!fits)
        throw UsageError("brush-weight: attribute = '" + name +
                         "' is not allowed: it is two or more letters, digits and underscores, no "
                         "digit first");
}

Outcome brush_weight(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const std::string& name = arguments.text("attribute");
    check_attribute(name);
    const Surface& before = surface_of(scene);
    Outcome outcome;
    outcome.resolved = arguments;
    Surface surface = painted({"brush-weight", kWeakest}, before,
                              {.kind = BrushKind::Weight, .attribute = name}, outcome, progress)
                          .surface();
    const auto& after = *surface.attributes.at(name);
    const auto known = before.attributes.find(name);
    const auto old = [&](std::size_t v) {
        return known == before.attributes.end() ? 0.0 : (*known->second)[v];
    };
    std::size_t changed = 0, above = 0;
    double largest = 0.0;
    for (std::size_t v = 0; v < after.size(); ++v) {
        changed += after[v] != old(v) ? 1 : 0;
        above += after[v] > 0.0 ? 1 : 0;
        largest = std::max(largest, std::abs(after[v] - old(v)));
    }
    ordered_json report = *outcome.report;
    report["attribute"] = name;
    report["vertices_changed"] = changed;
    report["largest_change"] = largest;
    report["vertices_above_0"] = above;
    outcome.report = std::make_shared<ordered_json>(std::move(report));
    outcome.scene = scene;
    outcome.scene.surface = std::move(surface);
    return outcome;
}

/// What all brushes have in common.
Operation brush(const DabUse& use, const std::string& summary, const std::string& strength) {
    return {.name = use.operation,
            .usual_step = Step::LocalRepair,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary = summary,
            .parameters = dab_parameters(use.weakest, strength),
            .thesis = "4.2.3-4.2.4"};
}

}  // namespace

Operation brush_smooth_operation() {
    Operation operation =
        brush({"brush-smooth", kSmoothWeakest},
              "smooth the wall under a brush; caps, rims and open boundaries stay",
              "share of the way to its ring's mean that the middle goes in a pass");
    operation.parameters.push_back({.name = "passes",
                                    .type = ParameterType::Integer,
                                    .default_value = std::int64_t{4},
                                    .help = "Laplace passes a dab; more is smoother",
                                    .minimum = 1,
                                    .maximum = 100});
    operation.run = &brush_smooth;
    return operation;
}

Operation brush_inflate_operation() {
    Operation operation =
        brush({"brush-inflate", kWeakest},
              "lift or lower the wall under a brush; caps, rims and open boundaries stay",
              "the middle moves out by a tenth of the brush's radius at 1, in at -1");
    operation.run = &brush_inflate;
    return operation;
}

Operation brush_weight_operation() {
    Operation operation =
        brush({"brush-weight", kWeakest}, "paint a weight on the surface's vertices",
              "added to the weight, which stays in 0 to 1");
    operation.parameters.push_back({.name = "attribute",
                                    .type = ParameterType::Text,
                                    .default_value = "painted_weight",
                                    .help = "name of the vertex attribute to paint; made where it "
                                            "is absent"});
    operation.run = &brush_weight;
    return operation;
}

}  // namespace vesselbench
