#include "smoothing/brush.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "geometry/wording.h"
#include "smoothing/new_crossings.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// Numbers of one dab in `dabs`: point, normal, local radius, radius, strength.
constexpr std::size_t kNumbers = 9;

Falloff falloff_from(const std::string& name) {
    if (name == "linear") return Falloff::Linear;
    return name == "constant" ? Falloff::Constant : Falloff::Smooth;
}

std::string dab_name(const std::string& operation, std::size_t i, const Dab& dab) {
    return operation + ": dab " + std::to_string(i + 1) + " at " + place_text(dab.anchor.point);
}

/// The stroke's dabs, all of them sensible.
std::vector<Dab> dabs_from(const std::string& operation, const Arguments& arguments,
                           double weakest) {
    const auto& numbers = arguments.list("dabs");
    if (numbers.empty() || numbers.size() % kNumbers != 0)
        throw UsageError(operation +
                         ": dabs needs 9 numbers a dab (point x,y,z, outward normal "
                         "x,y,z, local radius, radius, strength), not " +
                         std::to_string(numbers.size()));
    std::vector<Dab> dabs;
    for (std::size_t i = 0; i < numbers.size(); i += kNumbers) {
        const auto at = [&](std::size_t k) { return Eigen::Map<const Vec3>(&numbers[i + k]); };
        const Dab dab{
            .anchor = {.point = at(0), .normal = at(3), .radius = numbers[i + 6]},
            .radius = numbers[i + 7],
            .strength = numbers[i + 8],
            .falloff = falloff_from(arguments.text("falloff")),
        };
        const auto refuse = [&](const std::string& why) {
            throw UsageError(dab_name(operation, i / kNumbers, dab) + ": " + why);
        };
        if (!(dab.anchor.normal.norm() > 0.0)) refuse("its normal is 0,0,0");
        if (!(dab.anchor.radius > 0.0)) refuse("its local radius must be above 0 mm");
        if (!(dab.radius > 0.0)) refuse("its radius must be above 0 mm");
        if (!(dab.strength >= weakest && dab.strength <= 1.0))
            refuse(weakest < 0.0 ? "its strength must be -1 to 1" : "its strength must be 0 to 1");
        dabs.push_back(dab);
    }
    return dabs;
}

struct Painted {
    Surface surface;
    std::size_t empty_dabs = 0;  ///< that met no vertex
};

Painted painted(const Surface& surface, const BrushSettings& settings, const std::string& operation,
                const std::vector<Dab>& dabs, Progress& progress) {
    BrushStroke stroke(surface, settings);
    Painted result;
    for (std::size_t i = 0; i < dabs.size(); ++i) {
        progress.report(0.8 * static_cast<double>(i) / static_cast<double>(dabs.size()),
                        "brushing");
        try {
            if (stroke.add(dabs[i]).empty()) ++result.empty_dabs;
        } catch (const AlgorithmFailure& failure) {
            throw AlgorithmFailure(dab_name(operation, i, dabs[i]) + ": " + failure.what());
        }
    }
    result.surface = stroke.surface();
    return result;
}

void warn_of_empty_dabs(const Painted& result, Outcome& outcome) {
    if (result.empty_dabs > 0)
        outcome.warnings.push_back(
            counted(result.empty_dabs, "dab") +
            " changed nothing: strength 0, a radius below the triangles' size, or a cap");
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

Outcome moved_outcome(const Scene& scene, const Arguments& arguments, const Painted& result,
                      std::size_t dabs, Progress& progress) {
    const Surface& before = surface_of(scene);
    const Surface& after = result.surface;
    Outcome outcome;
    outcome.resolved = arguments;
    std::size_t count = 0;
    double largest = 0.0;
    for (std::size_t v = 0; v < before.vertex_count(); ++v) {
        if (after.points()[v] == before.points()[v]) continue;
        ++count;
        largest = std::max(largest, (after.points()[v] - before.points()[v]).norm());
    }
    outcome.report = std::make_shared<ordered_json>(
        ordered_json{{"dabs", dabs},
                     {"vertices_moved", count},
                     {"largest_displacement_mm", largest},
                     {"volume_change_mm3", volume_change(before, after)}});
    warn_of_empty_dabs(result, outcome);
    Positions apart = after.points();
    if (const auto taken = take_back_crossings(before, apart, progress.part(0.8, 1.0));
        taken.vertices > 0)
        outcome.warnings.push_back("the brushed wall passes through another one near " +
                                   place_text(taken.place) +
                                   ": undo, and brush with less strength");
    outcome.scene = with_surface(scene, after);
    return outcome;
}

Outcome brush_smooth(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const auto dabs = dabs_from("brush-smooth", arguments, 0.0);
    const BrushSettings settings{.kind = BrushKind::Smooth,
                                 .passes = static_cast<int>(arguments.integer("passes"))};
    const Painted result = painted(surface_of(scene), settings, "brush-smooth", dabs, progress);
    return moved_outcome(scene, arguments, result, dabs.size(), progress);
}

Outcome brush_inflate(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const auto dabs = dabs_from("brush-inflate", arguments, -1.0);
    const Painted result =
        painted(surface_of(scene), {.kind = BrushKind::Inflate}, "brush-inflate", dabs, progress);
    return moved_outcome(scene, arguments, result, dabs.size(), progress);
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
    const auto dabs = dabs_from("brush-weight", arguments, -1.0);
    const Surface& before = surface_of(scene);
    Painted result = painted(before, {.kind = BrushKind::Weight, .attribute = name}, "brush-weight",
                             dabs, progress);
    const auto& after = *result.surface.attributes.at(name);
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
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.report = std::make_shared<ordered_json>(ordered_json{{"dabs", dabs.size()},
                                                                 {"attribute", name},
                                                                 {"vertices_changed", changed},
                                                                 {"largest_change", largest},
                                                                 {"vertices_above_0", above}});
    warn_of_empty_dabs(result, outcome);
    outcome.scene = scene;
    outcome.scene.surface = std::move(result.surface);
    return outcome;
}

/// What all brushes have in common.
Operation brush(const std::string& name, const std::string& summary, const std::string& strength) {
    using enum ParameterType;
    return {.name = name,
            .usual_step = Step::LocalRepair,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary = summary,
            .parameters = {{.name = "dabs",
                            .type = List,
                            .unit = "mm",
                            .help = "the stroke, 9 numbers a dab: point x,y,z on the surface, "
                                    "outward normal x,y,z, local radius of the vessel, radius of "
                                    "the brush along the surface, strength " +
                                    strength,
                            .required = true},
                           {.name = "falloff",
                            .type = Choice,
                            .default_value = "smooth",
                            .help = "how the brush fades towards its radius: smooth (1 - t^2)^2, "
                                    "linear 1 - t, constant not at all",
                            .choices = {"smooth", "linear", "constant"}}},
            .thesis = "4.2.3-4.2.4"};
}

}  // namespace

Operation brush_smooth_operation() {
    Operation operation =
        brush("brush-smooth", "smooth the wall under a brush; caps, rims and open boundaries stay",
              "0 to 1");
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
        brush("brush-inflate",
              "lift or lower the wall under a brush; caps, rims and open boundaries stay",
              "-1 to 1: the middle moves out by a tenth of the brush's radius at 1, in at -1");
    operation.run = &brush_inflate;
    return operation;
}

Operation brush_weight_operation() {
    Operation operation = brush("brush-weight", "paint a weight on the surface's vertices",
                                "-1 to 1, added to the weight, which stays in 0 to 1");
    operation.parameters.push_back({.name = "attribute",
                                    .type = ParameterType::Text,
                                    .default_value = "painted_weight",
                                    .help = "name of the vertex attribute to paint; made where it "
                                            "is absent"});
    operation.run = &brush_weight;
    return operation;
}

}  // namespace vesselbench
