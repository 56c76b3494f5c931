#include "workbench/operations/brush/dabs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Of the parameters below.
constexpr std::array kNames = {"dabs", "at", "radius", "strength", "falloff"};

/// Defaults of a dab given by `at`.
constexpr double kStrength = 0.5, kFalloff = 1.0;

Dab dab_in(const Arguments& record) {
    return {.anchor = {.point = record.point("point"),
                       .normal = record.point("normal"),
                       .radius = record.real("vessel_radius")},
            .radius = record.real("radius"),
            .strength = record.real("strength"),
            .falloff = record.real("falloff")};
}

/// The way along a winding vessel is a few of its extents [diagonals of the bounding box].
constexpr double kLargest = 10.0;

std::vector<Dab> listed_dabs(const std::string& operation, const Surface& surface,
                             const Records& records) {
    if (records.list().empty()) throw_without_dabs(operation);
    std::vector<Dab> dabs;
    for (const Arguments& record : records.list()) {
        dabs.push_back(dab_in(record));
        if (!(dabs.back().anchor.normal.norm() > 0.0))
            throw UsageError(dab_name(operation, dabs.size() - 1, dabs.back()) +
                             ": its normal is 0,0,0");
    }
    const auto widest = std::ranges::max_element(dabs, {}, &Dab::radius);
    const auto index = static_cast<std::size_t>(widest - dabs.begin());
    const std::string name = dab_name(operation, index, *widest) + ": its radius";
    require_in_proportion(name.c_str(), widest->radius, surface, kLargest);
    return dabs;
}

/// `at` and its companions may be given with dabs only as resolved_dabs leaves them: with the same
/// meaning.
bool contradict(const Arguments& arguments, const std::vector<Dab>& dabs) {
    const auto other = [&](const char* name, double value) {
        return arguments.has(name) && arguments.real(name) != value;
    };
    if (!arguments.has("at"))
        return arguments.has("radius") || arguments.has("strength") || arguments.has("falloff");
    const Dab& dab = dabs.front();
    return dabs.size() != 1 || other("radius", dab.radius) || other("strength", dab.strength) ||
           other("falloff", dab.falloff);
}

/// A place farther away from the surface is of another model, or in another unit [radii].
constexpr double kFarthest = 10.0;

Dab single_dab(const std::string& operation, const Surface& surface, const SurfaceDistance& places,
               Outcome& outcome) {
    const Arguments& arguments = outcome.resolved;
    if (!arguments.has("at") || !arguments.has("radius")) throw_without_dabs(operation);
    const double radius = arguments.real("radius");
    require_in_proportion("radius", radius, surface, kLargest);
    const Vec3 at = arguments.point("at");
    const Dab dab{.anchor = nearest_anchor(surface, places, at, radius),
                  .radius = radius,
                  .strength = arguments.optional_real("strength").value_or(kStrength),
                  .falloff = arguments.optional_real("falloff").value_or(kFalloff)};
    const double off = (dab.anchor.point - at).norm();
    if (off <= radius) return dab;
    Diagnostic found{.code = "dab-off-surface",
                     .operation = operation,
                     .place = dab.anchor.point,
                     .figures = {{"distance_mm", off}},
                     .words = {{"given", coordinates_text(at)}}};
    if (off > kFarthest * radius) {
        found.code = "dab-too-far";
        found.figures["radii"] = kFarthest;
        throw DiagnosedFailure(std::move(found));
    }
    outcome.warnings.push_back(std::move(found));
    return dab;
}

std::vector<Parameter> dab_fields(double weakest, const std::string& strength) {
    using enum ParameterType;
    return {
        {.name = "point", .type = Point, .unit = "mm", .help = "on the surface", .required = true},
        {.name = "normal",
         .type = Point,
         .unit = "-",
         .help = "direction out of the vessel",
         .required = true},
        {.name = "vessel_radius",
         .unit = "mm",
         .help = "local radius of the vessel",
         .minimum = 0.0,
         .required = true,
         .above_minimum = true},
        {.name = "radius",
         .unit = "mm",
         .help = "radius of the brush along the surface",
         .minimum = 0.0,
         .required = true,
         .above_minimum = true},
        {.name = "strength",
         .unit = "-",
         .default_value = kStrength,
         .help = strength,
         .minimum = weakest,
         .maximum = 1.0},
        {.name = "falloff",
         .unit = "-",
         .default_value = kFalloff,
         .help = "fraction of the radius over which the brush fades towards its edge",
         .minimum = 0.0,
         .maximum = 1.0}};
}

}  // namespace

Records listed(std::span<const Dab> dabs) {
    std::vector<Arguments> records;
    for (const auto& [anchor, radius, strength, falloff] : dabs)
        records.push_back({{"point", anchor.point},
                           {"normal", anchor.normal},
                           {"vessel_radius", anchor.radius},
                           {"radius", radius},
                           {"strength", strength},
                           {"falloff", falloff}});
    return Records(std::move(records));
}

bool is_dab_argument(const std::string& name) {
    return std::ranges::count(kNames, name) > 0;
}

void throw_without_dabs(const std::string& operation) {
    throw UsageError(operation + ": give dabs, or at=x,y,z and radius= for one dab");
}

std::string dab_name(const std::string& operation, std::size_t index, const Dab& dab) {
    return operation + ": dab " + std::to_string(index + 1) + " at " + place_text(dab.anchor.point);
}

std::vector<Parameter> dab_parameters(double weakest, const std::string& strength) {
    using enum ParameterType;
    return {{.name = "dabs",
             .type = ParameterType::Records,
             .help = "the stroke, dab by dab; or use at",
             .meaning = Meaning::Dabs,
             .fields = dab_fields(weakest, strength)},
            {.name = "at",
             .type = Point,
             .unit = "mm",
             .help = "instead of dabs: one dab at the nearest point of the surface",
             .meaning = Meaning::Place},
            {.name = "radius",
             .unit = "mm",
             .help = "with at: radius of the brush along the surface",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "strength",
             .unit = "-",
             .help = "with at: " + strength + "; default 0.5",
             .minimum = weakest,
             .maximum = 1.0},
            {.name = "falloff",
             .unit = "-",
             .help = "with at: fraction of the radius over which the brush fades towards its edge: "
                     "1 fades from the centre, 0 not at all; default 1",
             .minimum = 0.0,
             .maximum = 1.0}};
}

std::vector<Dab> resolved_dabs(const std::string& operation, const Surface& surface,
                               const SurfaceDistance& places, Outcome& outcome) {
    Arguments& arguments = outcome.resolved;
    if (arguments.has("dabs")) {
        auto dabs = listed_dabs(operation, surface, arguments.records("dabs"));
        if (contradict(arguments, dabs))
            throw UsageError(operation +
                             ": give dabs, or at with radius, strength and falloff, not both");
        return dabs;
    }
    const Dab dab = single_dab(operation, surface, places, outcome);
    arguments.set("dabs", listed({&dab, 1}));
    arguments.set("strength", dab.strength);
    arguments.set("falloff", dab.falloff);
    return {dab};
}

}  // namespace vesselbench
