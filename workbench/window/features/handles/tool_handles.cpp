#include "workbench/window/features/handles/tool_handles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/stamp/tool.h"
#include "workbench/window/features/handles/handle_values.h"

namespace vesselbench {

namespace {

constexpr double kLeastSize = 0.05;   ///< of a tool that is dragged [mm]
constexpr double kOfferedPath = 0.1;  ///< half its length, of the model's diagonal [-]
constexpr double kArm = 0.5;          ///< of the direction's handle, of the tool's reach [-]
constexpr double kNextPoint = 0.5;    ///< from a path's end to the next one, of its last segment

/// What the operation would use: the given values, else those that it decides.
Arguments used_values(const OperationForm& form) {
    Arguments used;
    for (const FormField& field : form.fields()) {
        const std::string& name = field.parameter->name;
        if (const auto given = value_of(form, name))
            used.set(name, *given);
        else if (field.automatic)
            used.set(name, *field.automatic);
        else if (field.parameter->default_value)
            used.set(name, *field.parameter->default_value);
    }
    return used;
}

Positions path_of(const Arguments& used) {
    return used.has("path") && used.list("path").size() % 3 == 0 ? path_from(used.list("path"))
                                                                 : Positions();
}

/// \return true if it is offered: the form gives none
bool offer_path(const Bounds& model, Arguments& used) {
    if (path_of(used).size() >= 2) return false;
    const Vec3 half = kOfferedPath * model.diagonal() * Vec3::UnitX();
    std::vector<double> numbers;
    for (const Vec3& p : {Vec3(model.centre() - half), Vec3(model.centre() + half)})
        for (int axis = 0; axis < 3; ++axis) numbers.push_back(p[axis]);
    used.set("path", numbers);
    if (!used.has("radius")) used.set("radius", 0.25 * half.norm());
    return true;
}

/// None while something of the tool is not known, or wrong.
std::optional<ToolBody> body_of(const Arguments& used) {
    const bool swept = used.text("shape") == "polygon", box = used.text("shape") == "box";
    const std::vector<std::string> needed =
        swept ? std::vector<std::string>{"path", "radius"}
        : box ? std::vector<std::string>{"centre",    "direction", "along",
                                         "thickness", "length",    "width"}
              : std::vector<std::string>{"centre", "direction", "length", "radius"};
    if (!std::ranges::all_of(needed, [&](const auto& name) { return used.has(name); })) return {};
    try {
        return tool_from(used);
    } catch (const std::exception&) {
        return std::nullopt;  // the form says what is wrong with its texts
    }
}

/// A handle and what its drag gives.
struct Grip {
    Handle handle;
    std::function<std::vector<FieldText>(const Vec3& to)> texts;
};

FieldText length_text(const std::string& name, double length) {
    return {name, to_text(Value(std::max(kLeastSize, rounded_length(length))))};
}

/// A size that is dragged along a line from the centre. \param ends how much of it is on one side
Grip size_grip(const std::string& name, const Vec3& centre, const Vec3& axis, double from,
               double size, double ends, const std::string& help) {
    return {{.name = "tool." + name,
             .point = centre + (from + ends * size) * axis,
             .path = HandlePath::Line,
             .direction = axis,
             .help = help},
            [=](const Vec3& to) {
                return std::vector{length_text(name, ((to - centre).dot(axis) - from) / ends)};
            }};
}

std::vector<Grip> placed_grips(const Arguments& used, const ToolBody& body) {
    const Vec3 centre = used.point("centre"), direction = used.point("direction").normalized();
    std::vector<Grip> grips = {
        {{.name = "tool.centre",
          .point = centre,
          .look = HandleLook::Square,
          .help = "Move the tool in the plane of the view"},
         [](const Vec3& to) { return std::vector{point_text("centre", to)}; }}};
    const bool box = used.text("shape") == "box";
    const double length = used.real("length");
    const double far = (box ? 0.5 * used.real("thickness") : 0.5 * length + used.real("radius")) +
                       kArm * body.reach;
    grips.push_back(
        {{.name = "tool.direction",
          .point = centre + far * direction,
          .path = HandlePath::Ball,
          .pivot = centre,
          .look = HandleLook::Ring,
          .help = "Turn the tool"},
         [=](const Vec3& to) { return std::vector{direction_text("direction", to - centre)}; }});
    if (!box) {
        const Vec3 side = plane_axes(direction).first;
        grips.push_back(size_grip("radius", centre, side, 0.0, used.real("radius"), 1.0,
                                  "Change the capsule's radius"));
        grips.push_back(size_grip("length", centre, -direction, used.real("radius"), length, 0.5,
                                  "Change the capsule's length"));
        return grips;
    }
    const Vec3 given = used.point("along");
    const Vec3 along = (given - given.dot(direction) * direction).normalized();
    const Vec3 across = direction.cross(along);
    grips.push_back(size_grip("thickness", centre, direction, 0.0, used.real("thickness"), 0.5,
                              "Change the thickness: the gap that is left"));
    grips.push_back(size_grip("length", centre, along, 0.0, length, 0.5, "Change the length"));
    grips.push_back(
        size_grip("width", centre, across, 0.0, used.real("width"), 0.5, "Change the width"));
    return grips;
}

std::vector<FieldText> path_texts(const Positions& path) {
    std::vector<double> numbers;
    for (const Vec3& point : path)
        for (int axis = 0; axis < 3; ++axis) numbers.push_back(rounded_place(point)[axis]);
    return {{"path", to_text(Value(numbers))}};
}

std::vector<Grip> path_grips(const Arguments& used) {
    const Positions path = path_of(used);
    std::vector<Grip> grips;
    for (std::size_t i = 0; i < path.size(); ++i)
        grips.push_back({{.name = "tool.path." + std::to_string(i),
                          .point = path[i],
                          .look = HandleLook::Square,
                          .help = "Move this point of the path in the plane of the view"},
                         [=](const Vec3& to) {
                             Positions moved = path;
                             moved[i] = to;
                             return path_texts(moved);
                         }});
    const Vec3& last = path.back();
    const Vec3 step = last - path[path.size() - 2];
    grips.push_back({{.name = "tool.path.add",
                      .point = last + kNextPoint * step,
                      .look = HandleLook::Ring,
                      .help = "Draw the path on: adds a point"},
                     [=](const Vec3& to) {
                         Positions longer = path;
                         longer.push_back(to);
                         return path_texts(longer);
                     }});
    return grips;
}

std::vector<Grip> grips_of(const Arguments& used, const ToolBody& body) {
    return used.text("shape") == "polygon" ? path_grips(used) : placed_grips(used, body);
}

/// Rings of a body that was made ring by ring, and lines along it.
void add_rings(const Positions& points, std::size_t around, std::vector<RegionLine>& lines) {
    const std::size_t rings = (points.size() - 2) / around;  // the last two are the tips
    for (std::size_t r = 0; r < rings; ++r) {
        RegionLine ring{.closed = true};
        for (std::size_t k = 0; k < around; ++k) ring.points.push_back(points[r * around + k]);
        lines.push_back(std::move(ring));
    }
    for (std::size_t k = 0; k < around; ++k) {
        RegionLine rail;
        for (std::size_t r = 0; r < rings; ++r) rail.points.push_back(points[r * around + k]);
        lines.push_back(std::move(rail));
    }
}

std::vector<RegionLine> body_lines(const Arguments& used, const ToolBody& body) {
    std::vector<RegionLine> lines;
    const std::string& shape = used.text("shape");
    if (shape == "capsule") {
        const Vec3 centre = used.point("centre"), axis = used.point("direction").normalized();
        const double radius = used.real("radius"), half = 0.5 * used.real("length");
        for (const double side : {-half, half})
            for (RegionLine& line : ball_lines(centre + side * axis, radius))
                lines.push_back(std::move(line));
        const auto [x, y] = plane_axes(axis);
        for (const Vec3& out : {x, y, Vec3(-x), Vec3(-y)})
            lines.push_back({.points = {centre - half * axis + radius * out,
                                        centre + half * axis + radius * out}});
        return lines;
    }
    const auto around =
        shape == "box" ? std::size_t{4} : static_cast<std::size_t>(used.integer("sides"));
    add_rings(body.surface.points(), around, lines);
    return lines;
}

std::string size_text(const Arguments& used) {
    const auto of = [&](const char* name) { return formatted(used.real(name), "%.2f"); };
    if (used.text("shape") == "box")
        return of("thickness") + " \u00D7 " + of("length") + " \u00D7 " + of("width") + " mm";
    return "radius " + of("radius") + " mm";
}

}  // namespace

bool has_tool(const OperationForm& form) {
    const auto has = [&](const char* name) {
        return std::ranges::any_of(form.operation().parameters,
                                   [&](const Parameter& each) { return each.name == name; });
    };
    return has("shape") && has("centre") && has("direction") && has("path");
}

FormShape tool_shape(const OperationForm& form, const Bounds& model) {
    Arguments used = used_values(form);
    const bool offered = used.text("shape") == "polygon" && offer_path(model, used);
    const auto body = body_of(used);
    if (!body) return {};
    FormShape shape{.lines = body_lines(used, *body)};
    for (Grip& grip : grips_of(used, *body)) shape.handles.push_back(std::move(grip.handle));
    for (RegionLine& line : shape.lines) line.faint = offered;
    shape.notes.push_back({.point = body->centre, .text = size_text(used), .below = true});
    return shape;
}

std::vector<FieldText> tool_texts(const OperationForm& form, const Bounds& model,
                                  std::size_t handle, const Vec3& to) {
    Arguments used = used_values(form);
    if (used.text("shape") == "polygon") offer_path(model, used);
    const auto body = body_of(used);
    if (!body) return {};
    return grips_of(used, *body).at(handle).texts(to);
}

}  // namespace vesselbench
