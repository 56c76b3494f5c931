#include "workbench/operations/clip_opening/parameters.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/operations/shared/opening_arguments.h"

namespace vesselbench {

namespace {

/// Which end, and where it is cut.
std::vector<Parameter> place_parameters() {
    using enum ParameterType;
    const Condition of_one{"tip"};
    return {{.name = "tip",
             .type = Point,
             .unit = "mm",
             .help = "a point near the tip of the branch to open; default: every vessel end",
             .meaning = Meaning::Tip},
            {.name = "distance",
             .unit = "mm",
             .help = "distance of the cut from the tip along the centerline; default: the nearest "
                     "straight place",
             .minimum = 0.0,
             .above_minimum = true,
             .only_with = of_one},
            {.name = "radii",
             .unit = "-",
             .help = "the same distance in radii of the vessel at its tip",
             .minimum = 0.0,
             .above_minimum = true,
             .only_with = of_one},
            {.name = "inlet",
             .type = List,
             .unit = "mm",
             .help = "a point near the opening where the blood flows in, or x,y,z of each of "
                     "several; default: that of the widest vessel",
             .meaning = Meaning::Inlet},
            {.name = "name",
             .type = Text,
             .help = "name of the opening at tip; default: inlet, outlet_1, outlet_2 ... by size",
             .only_with = of_one,
             .meaning = Meaning::Name},
            {.name = "kind",
             .type = Choice,
             .help = "role of the opening at tip for the solver; default: by size",
             .choices = {"inlet", "outlet"},
             .only_with = of_one}};
}

/// How the blood runs through the ends.
Parameter vessel_parameter() {
    return {.name = "vessel",
            .type = ParameterType::Choice,
            .help =
                "artery or portal: the blood enters at the trunk's end and leaves at all others; "
                "vein: it enters at all others and leaves at the trunk's; default: as in an "
                "artery",
            .choices = {kArtery, kVein, kPortalVein}};
}

/// Which ends are opened, if all of them are looked at.
std::vector<Parameter> choice_parameters() {
    using enum ParameterType;
    return {{.name = "open",
             .type = List,
             .unit = "mm",
             .help = "ends that are opened although they look closed, such as short ones: x,y,z of "
                     "each",
             .meaning = Meaning::Tip},
            {.name = "closed",
             .type = List,
             .unit = "mm",
             .help = "ends that stay closed on purpose: x,y,z of each",
             .meaning = Meaning::Tip},
            {.name = "inlet_ends",
             .type = List,
             .unit = "-",
             .help = "the inlets by their numbers, as the list of ends has them",
             .meaning = Meaning::InletEnd,
             .use = Use::Rare},
            {.name = "open_ends",
             .type = List,
             .unit = "-",
             .help = "ends that are opened, by their numbers",
             .use = Use::Rare},
            {.name = "close_ends",
             .type = List,
             .unit = "-",
             .help = "ends that stay closed, by their numbers",
             .use = Use::Rare},
            {.name = "accept_doubts",
             .type = Flag,
             .default_value = false,
             .help = "where the odds do not decide about an end, take the likelier choice",
             .meaning = Meaning::Doubts},
            {.name = "strict",
             .type = Flag,
             .default_value = false,
             .help = "cut every end perpendicular to its vessel, also one with a flat rim; fails "
                     "at the first end that cannot be cut",
             .use = Use::Rare},
            {.name = "check",
             .type = Choice,
             .default_value = "flow",
             .help = "flow: fail unless there are two openings and the largest end is one of "
                     "them; none: no such check",
             .choices = {"flow", "none"},
             .use = Use::Rare},
            {.name = "closed_ends",
             .type = Choice,
             .default_value = "open",
             .help = "open: closed ends are opened where the surface's rims are not all its ends; "
                     "leave: closed ends and the caps at an image's border stay as they are, as a "
                     "print needs no openings",
             .choices = {"open", "leave"},
             .use = Use::Rare}};
}

/// What a run decides.
std::vector<Parameter> decision_parameters() {
    return {{.name = "planes",
             .type = ParameterType::Records,
             .help = "the openings, which are made as they are",
             .meaning = Meaning::Planes,
             .use = Use::Decision,
             .fields = plane_fields()},
            {.name = "names",
             .type = ParameterType::Records,
             .help = "role and name of each opening of planes, in their order",
             .meaning = Meaning::Roles,
             .use = Use::Decision,
             .fields = name_fields()},
            {.name = "closings",
             .type = ParameterType::Records,
             .help = "with planes: what becomes of ends without an opening",
             .meaning = Meaning::Planes,
             .use = Use::Decision,
             .fields = closing_fields()}};
}

}  // namespace

std::vector<Parameter> clip_opening_parameters() {
    std::vector<Parameter> all = place_parameters();
    all.push_back(vessel_parameter());
    for (Parameter& parameter : choice_parameters()) all.push_back(std::move(parameter));
    for (Parameter& parameter : decision_parameters()) all.push_back(std::move(parameter));
    return all;
}

void check_clip_arguments(const Arguments& arguments) {
    if ((arguments.has("name") || arguments.has("kind")) && !arguments.has("tip") &&
        !arguments.has("planes"))
        throw UsageError("clip-opening: name and kind belong to one opening: give its tip, too");
    if (arguments.has("distance") && arguments.has("radii"))
        throw UsageError("clip-opening: give distance or radii, not both");
    if (arguments.has("planes") != arguments.has("names"))
        throw UsageError("clip-opening: give planes and names together");
    for (const char* name : {"open", "closed", "inlet"})
        if (arguments.has(name) && arguments.list(name).size() % 3 != 0)
            throw UsageError("clip-opening: " + std::string(name) +
                             " needs three numbers for each end");
}

bool gathers(const Arguments& arguments) {
    return arguments.optional_text("vessel") == kVein;
}

Arguments with_found_places(Arguments given, const Arguments& resolved) {
    for (const NumberParameter& parameter : kNumberParameters) {
        if (!given.has(parameter.numbers) || !resolved.has(parameter.places)) continue;
        given.set(parameter.places, resolved.list(parameter.places));
        given.remove(parameter.numbers);
    }
    return given;
}

bool names_numbers(const Arguments& arguments) {
    return std::ranges::any_of(kNumberParameters,
                               [&](const auto& p) { return arguments.has(p.numbers); });
}

Positions points_of(const Arguments& arguments, const char* name) {
    if (!arguments.has(name)) return {};
    const std::vector<double>& numbers = arguments.list(name);
    Positions points;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

OpeningPlanOptions plan_options(const Arguments& arguments, const std::optional<Image>& image) {
    OpeningPlanOptions options{.tip = arguments.optional_point("tip"),
                               .distance = arguments.optional_real("distance"),
                               .radii = arguments.optional_real("radii"),
                               .strict = arguments.flag("strict"),
                               .border_cuts = image.has_value()};
    options.gathers = gathers(arguments);
    options.accept_doubts = arguments.flag("accept_doubts");
    options.leave_closed = arguments.text("closed_ends") == "leave";
    if (options.leave_closed) options.border_cuts = false;
    if (image)
        options.image = ImageBox{.size = image->size, .index_to_patient = image->index_to_patient};
    if (!options.tip) options.inlets = points_of(arguments, "inlet");
    options.open = points_of(arguments, "open");
    options.closed = points_of(arguments, "closed");
    return options;
}

}  // namespace vesselbench
