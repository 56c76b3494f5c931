#include "workbench/operations/stamp/tool.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "meshing/stamp/contact.h"
#include "smoothing/brush/brush.h"

namespace vesselbench {

namespace {

constexpr double kGap = 0.25;    ///< default thickness, of the waist's width [-]
constexpr double kBeyond = 1.3;  ///< default length and width, of the waist's [-]
constexpr double kThick = 0.5;   ///< default thickness or radius elsewhere, of the vessel's radius
constexpr double kLong = 2.0;    ///< default length and width elsewhere, of the vessel's radius
constexpr double kBlend = 0.25;  ///< default, of the thickness or radius [-]

void set_if_missing(Arguments& arguments, const std::string& name, const Value& value) {
    if (!arguments.has(name)) arguments.set(name, value);
}

void resolve_box_at(const Contact& contact, Arguments& arguments) {
    set_if_missing(arguments, "centre", contact.centre);
    set_if_missing(arguments, "direction", contact.direction);
    set_if_missing(arguments, "along", contact.along);
    set_if_missing(arguments, "thickness", kGap * contact.width);
    const double thickness = arguments.real("thickness");
    set_if_missing(arguments, "length", kBeyond * contact.length + thickness);
    set_if_missing(arguments, "width", kBeyond * contact.width + thickness);
}

Anchor anchor_at(const Surface& surface, const SurfaceDistance& places, const Vec3& at) {
    return nearest_anchor(surface, places, at, mean_edge_length(surface));
}

void resolve_at_anchor(const Anchor& anchor, bool is_box, Arguments& arguments) {
    set_if_missing(arguments, "centre", anchor.point);
    set_if_missing(arguments, "direction", Vec3(anchor.normal.normalized()));
    if (!is_box) {
        set_if_missing(arguments, "radius", kThick * anchor.radius);
        set_if_missing(arguments, "length", kLong * anchor.radius);
        return;
    }
    set_if_missing(arguments, "along", plane_axes(arguments.point("direction").normalized()).first);
    set_if_missing(arguments, "thickness", kThick * anchor.radius);
    set_if_missing(arguments, "length", kLong * anchor.radius);
    set_if_missing(arguments, "width", kLong * anchor.radius);
}

/// A box whose place or direction is left out belongs to a contact.
void resolve_box(const Surface& surface, const SurfaceDistance& places, const Vec3& at,
                 Arguments& arguments) {
    const bool aligned = arguments.has("direction");
    if (!aligned) {
        const auto contact = contact_at(surface, places, at);
        if (!contact)
            throw DiagnosedFailure({.code = "no-contact",
                                    .operation = "stamp",
                                    .place = at,
                                    .remedies = {{.arguments = {{"direction", ""}}}}});
        return resolve_box_at(*contact, arguments);
    }
    resolve_at_anchor(anchor_at(surface, places, at), true, arguments);
}

void resolve_swept(const Surface& surface, const SurfaceDistance& places, Arguments& arguments) {
    if (!arguments.has("path"))
        throw UsageError("stamp: give path=x,y,z,x,y,z,... with two points or more for a polygon");
    const Positions path = path_from(arguments.list("path"));
    set_if_missing(arguments, "radius", kThick * anchor_at(surface, places, path.front()).radius);
}

Condition with_shape(std::vector<std::string> shapes) {
    return {"shape", std::move(shapes)};
}

std::vector<Parameter> place_parameters() {
    using enum ParameterType;
    const Condition placed = with_shape({"box", "capsule"});
    return {{.name = "shape",
             .type = Choice,
             .default_value = "box",
             .help = "the tool's body; a polygon is swept along path",
             .choices = {"box", "capsule", "polygon"}},
            {.name = "at",
             .type = Point,
             .unit = "mm",
             .help = "a place on the wall of the contact, from which the box takes its plane and "
                     "its waist; of a capsule: its centre",
             .only_with = placed,
             .meaning = Meaning::Place},
            {.name = "centre",
             .type = Point,
             .unit = "mm",
             .help = "middle of the tool; default: that of the contact's waist, or at",
             .only_with = placed,
             .meaning = Meaning::Place},
            {.name = "direction",
             .type = Point,
             .unit = "-",
             .help = "across which the box is as thick as thickness, or along which a capsule "
                     "lies; default: across the contact; of a capsule: out of the wall",
             .only_with = placed},
            {.name = "along",
             .type = Point,
             .unit = "-",
             .help = "direction of the box's length; default: the longer side of the contact's "
                     "waist",
             .only_with = with_shape({"box"}),
             .use = Use::Rare}};
}

Parameter size_parameter(const char* name, const char* help, std::vector<std::string> shapes) {
    return {.name = name,
            .unit = "mm",
            .help = help,
            .minimum = 0.0,
            .above_minimum = true,
            .only_with = with_shape(std::move(shapes))};
}

std::vector<Parameter> size_parameters() {
    return {
        size_parameter("thickness",
                       "the gap that a box leaves; default: a quarter of the waist's width",
                       {"box"}),
        size_parameter("radius",
                       "of a capsule, or of a polygon's corners; default: half the vessel's radius",
                       {"capsule", "polygon"}),
        size_parameter("length",
                       "of a box, or of a capsule without its ends; default: a third more than the "
                       "waist's; else the vessel's diameter",
                       {"box", "capsule"}),
        size_parameter("width", "of a box; default: a third more than the waist's", {"box"})};
}

std::vector<Parameter> path_parameters() {
    return {{.name = "path",
             .type = ParameterType::List,
             .unit = "mm",
             .help = "the points of the path, x, y, z one after the other",
             .only_with = with_shape({"polygon"})},
            {.name = "sides",
             .type = ParameterType::Integer,
             .default_value = std::int64_t{6},
             .help = "of the polygon",
             .minimum = 3,
             .maximum = 64,
             .only_with = with_shape({"polygon"})}};
}

}  // namespace

void resolve_tool(const Surface& surface, const SurfaceDistance& places, Arguments& arguments) {
    const std::string& shape = arguments.text("shape");
    if (shape == "polygon") {
        resolve_swept(surface, places, arguments);
    } else {
        const auto at = arguments.has("at") ? arguments.optional_point("at")
                                            : arguments.optional_point("centre");
        if (!at) throw UsageError("stamp: give at=x,y,z, or centre=x,y,z of the tool");
        if (shape == "box")
            resolve_box(surface, places, *at, arguments);
        else
            resolve_at_anchor(anchor_at(surface, places, *at), false, arguments);
    }
    set_if_missing(arguments, "blend",
                   kBlend * arguments.real(shape == "box" ? "thickness" : "radius"));
}

Positions path_from(const std::vector<double>& numbers) {
    if (numbers.size() % 3 != 0)
        throw UsageError("stamp: path needs three numbers for each point, not " +
                         std::to_string(numbers.size()) + " numbers");
    Positions path;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        path.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return path;
}

ToolBody tool_from(const Arguments& arguments) {
    const std::string& shape = arguments.text("shape");
    if (shape == "polygon") {
        const Positions path = path_from(arguments.list("path"));
        return swept_body({.path = path,
                           .sides = static_cast<std::size_t>(arguments.integer("sides")),
                           .radius = arguments.real("radius")});
    }
    const Vec3 centre = arguments.point("centre"), direction = arguments.point("direction");
    if (shape == "capsule")
        return capsule_body({.centre = centre,
                             .direction = direction,
                             .length = arguments.real("length"),
                             .radius = arguments.real("radius")});
    return box_body({.centre = centre,
                     .direction = direction,
                     .along = arguments.point("along"),
                     .thickness = arguments.real("thickness"),
                     .length = arguments.real("length"),
                     .width = arguments.real("width")});
}

std::vector<Parameter> tool_parameters() {
    std::vector<Parameter> table = place_parameters();
    for (std::vector<Parameter> more : {size_parameters(), path_parameters()})
        std::ranges::move(more, std::back_inserter(table));
    return table;
}

}  // namespace vesselbench
