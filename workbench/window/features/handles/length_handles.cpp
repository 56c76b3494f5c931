#include "workbench/window/features/handles/length_handles.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/measure_json.h"

namespace vesselbench {

namespace {

constexpr double kLeastShare = 0.1;  ///< of a diameter: what a drag cannot go below [-]
constexpr int kRails = 4;            ///< lines along a tube

std::vector<std::string> named_in(const std::string& text) {
    std::vector<std::string> names;
    std::istringstream list(text);
    for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    return names;
}

/// Of each opening [mm].
std::vector<double> lengths_of(const OperationForm& form,
                               const std::vector<PatchMeasures>& openings) {
    std::vector<double> lengths = list_of(form, "lengths");
    if (lengths.size() == openings.size()) return lengths;
    lengths.clear();
    const auto same = number_of(form, "length");
    for (const PatchMeasures& opening : openings)
        lengths.push_back(
            same.value_or(used_number(form, "diameters") * diameter_of_area(opening.area)));
    return lengths;
}

/// Whole diameters within `snap` [mm], and at least a little. \return [mm]
double dragged_length(double length, double diameter, double snap) {
    const double whole = std::round(length / diameter);
    if (whole >= 1.0 && std::abs(length - whole * diameter) <= snap) return whole * diameter;
    return std::max(length, kLeastShare * diameter);
}

/// "12 mm = 3 diameters"
std::string length_text(double length, double diameter) {
    return formatted(length, "%.4g mm = ") + formatted(length / diameter, "%.3g diameters");
}

void add_tube(std::vector<RegionLine>& lines, const PatchMeasures& opening, double length) {
    const double radius = diameter_of_area(opening.area) / 2;
    const Vec3 along = length * opening.normal;
    const RegionLine start = circle_line(opening.centroid, opening.normal, radius);
    RegionLine end = start;
    for (Vec3& point : end.points) point += along;
    const std::size_t step = start.points.size() / kRails;
    for (std::size_t i = 0; i < start.points.size(); i += step)
        lines.push_back({.points = {start.points[i], end.points[i]}});
    lines.push_back(std::move(end));
}

}  // namespace

std::vector<PatchMeasures> lengthened_openings(const OperationForm& form,
                                               const std::vector<PatchMeasures>& openings) {
    const std::vector<std::string> names = named_in(text_of(form, "opening"));
    std::vector<PatchMeasures> chosen;
    std::ranges::copy_if(openings, std::back_inserter(chosen), [&](const PatchMeasures& opening) {
        const bool open = opening.kind == PatchKind::Inlet || opening.kind == PatchKind::Outlet;
        return names.empty() ? open : std::ranges::count(names, opening.name) > 0;
    });
    return chosen;
}

FormShape length_shape(const OperationForm& form, const std::vector<PatchMeasures>& openings) {
    FormShape shape;
    const std::vector<PatchMeasures> chosen = lengthened_openings(form, openings);
    const std::vector<double> lengths = lengths_of(form, chosen);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const PatchMeasures& opening = chosen[i];
        const Vec3 end = opening.centroid + lengths[i] * opening.normal;
        add_tube(shape.lines, opening, lengths[i]);
        shape.handles.push_back({.name = "length." + opening.name,
                                 .point = end,
                                 .path = HandlePath::Line,
                                 .direction = opening.normal,
                                 .help = "Lengthen " + opening.name + " along its axis"});
        shape.notes.push_back({end, length_text(lengths[i], diameter_of_area(opening.area))});
    }
    return shape;
}

std::vector<FieldText> length_texts(const OperationForm& form,
                                    const std::vector<PatchMeasures>& openings, std::size_t handle,
                                    const Vec3& to, double snap) {
    const std::vector<PatchMeasures> chosen = lengthened_openings(form, openings);
    const PatchMeasures& opening = chosen.at(handle);
    const double diameter = diameter_of_area(opening.area);
    std::vector<double> lengths = lengths_of(form, chosen);
    lengths[handle] = dragged_length(opening.normal.dot(to - opening.centroid), diameter, snap);
    std::string names;
    for (const PatchMeasures& each : chosen) names += (names.empty() ? "" : ",") + each.name;
    for (double& length : lengths) length = rounded_length(length);
    return {{"opening", names}, {"lengths", to_text(Value(lengths))}};
}

}  // namespace vesselbench
