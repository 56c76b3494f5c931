#include "workbench/operations/brush/dabs.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Numbers of one dab in `dabs`: point, normal, local radius, radius, strength, falloff.
constexpr std::size_t kNumbers = 10;

/// Of the parameters below.
constexpr std::array kNames = {"dabs", "at", "radius", "strength", "falloff"};

/// Defaults of a dab given by `at`.
constexpr double kStrength = 0.5, kFalloff = 1.0;

Dab dab_from(std::span<const double> n) {
    return {.anchor = {.point = {n[0], n[1], n[2]}, .normal = {n[3], n[4], n[5]}, .radius = n[6]},
            .radius = n[7],
            .strength = n[8],
            .falloff = n[9]};
}

void check(const std::string& name, double weakest, const Dab& dab) {
    const auto refuse = [&](const std::string& what, double value, const std::string& allowed) {
        std::ostringstream text;
        text << name << ": its " << what << " = " << value << " must be " << allowed;
        throw UsageError(text.str());
    };
    if (!(dab.anchor.normal.norm() > 0.0)) throw UsageError(name + ": its normal is 0,0,0");
    if (!(dab.anchor.radius > 0.0)) refuse("local radius", dab.anchor.radius, "above 0 mm");
    if (!(dab.radius > 0.0)) refuse("radius", dab.radius, "above 0 mm");
    if (!(dab.strength >= weakest && dab.strength <= 1.0))
        refuse("strength", dab.strength, weakest < 0.0 ? "-1 to 1" : "0 to 1");
    if (!(dab.falloff >= 0.0 && dab.falloff <= 1.0)) refuse("falloff", dab.falloff, "0 to 1");
}

/// The way along a winding vessel is a few of its extents [diagonals of the bounding box].
constexpr double kLargest = 10.0;

std::vector<Dab> listed_dabs(const DabUse& use, const Surface& surface,
                             const std::vector<double>& numbers) {
    if (numbers.empty() || numbers.size() % kNumbers != 0)
        throw UsageError(use.operation +
                         ": dabs needs 10 numbers per dab (point x,y,z, outward normal x,y,z, "
                         "local radius, radius, strength, falloff), not " +
                         std::to_string(numbers.size()));
    std::vector<Dab> dabs;
    for (std::size_t i = 0; i < numbers.size(); i += kNumbers) {
        dabs.push_back(dab_from(std::span(numbers).subspan(i, kNumbers)));
        check(dab_name(use.operation, dabs.size() - 1, dabs.back()), use.weakest, dabs.back());
    }
    const auto widest = std::ranges::max_element(dabs, {}, &Dab::radius);
    const auto index = static_cast<std::size_t>(widest - dabs.begin());
    const std::string name = dab_name(use.operation, index, *widest) + ": its radius";
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

Dab single_dab(const DabUse& use, const Surface& surface, const SurfaceDistance& places,
               Outcome& outcome) {
    const Arguments& arguments = outcome.resolved;
    if (!arguments.has("at") || !arguments.has("radius")) throw_without_dabs(use);
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
                     .operation = use.operation,
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

}  // namespace

std::vector<double> listed(const Dab& dab) {
    const auto& [point, normal, local_radius] = dab.anchor;
    return {point.x(),  point.y(),    point.z(),  normal.x(),   normal.y(),
            normal.z(), local_radius, dab.radius, dab.strength, dab.falloff};
}

bool is_dab_argument(const std::string& name) {
    return std::ranges::count(kNames, name) > 0;
}

void append_dabs(Arguments& stroke, const Arguments& more) {
    std::vector<double> all = stroke.has("dabs") ? stroke.list("dabs") : std::vector<double>();
    const std::vector<double>& added = more.list("dabs");
    all.insert(all.end(), added.begin(), added.end());
    for (const auto& [name, value] : more.values()) stroke.set(name, value);
    stroke.set("dabs", std::move(all));
}

void throw_without_dabs(const DabUse& use) {
    throw UsageError(use.operation + ": give dabs, or at=x,y,z and radius= for one dab");
}

std::string dab_name(const std::string& operation, std::size_t index, const Dab& dab) {
    return operation + ": dab " + std::to_string(index + 1) + " at " + place_text(dab.anchor.point);
}

std::vector<Parameter> dab_parameters(double weakest, const std::string& strength) {
    using enum ParameterType;
    return {{.name = "dabs",
             .type = List,
             .unit = "mm",
             .help = "the stroke, 10 numbers per dab: point x,y,z on the surface, outward normal "
                     "x,y,z, local radius of the vessel, radius of the brush along the surface, "
                     "strength and falloff as below; or use at",
             .meaning = Meaning::Dabs,
             .use = Use::Recorded},
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

std::vector<Dab> resolved_dabs(const DabUse& use, const Surface& surface,
                               const SurfaceDistance& places, Outcome& outcome) {
    Arguments& arguments = outcome.resolved;
    if (arguments.has("dabs")) {
        auto dabs = listed_dabs(use, surface, arguments.list("dabs"));
        if (contradict(arguments, dabs))
            throw UsageError(use.operation +
                             ": give dabs, or at with radius, strength and falloff, not both");
        return dabs;
    }
    const Dab dab = single_dab(use, surface, places, outcome);
    arguments.set("dabs", listed(dab));
    arguments.set("strength", dab.strength);
    arguments.set("falloff", dab.falloff);
    return {dab};
}

}  // namespace vesselbench
