#include "workbench/window/model/edit_places.h"

#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"
#include "workbench/window/model/pick_target.h"

namespace vesselbench {

namespace {

constexpr std::size_t kDabNumbers = 10;  ///< of a dab in `dabs`

const std::vector<double>* list_in(const Arguments& arguments, const std::string& name) {
    return arguments.has(name) ? &arguments.list(name) : nullptr;
}

Vec3 point_in(const std::vector<double>& numbers, std::size_t from) {
    return {numbers.at(from), numbers.at(from + 1), numbers.at(from + 2)};
}

/// Points that the user can pick.
Positions points_in(const Operation& operation, const Arguments& arguments) {
    Positions points;
    for (const Parameter& parameter : operation.parameters)
        if (parameter.type == ParameterType::Point && arguments.has(parameter.name) &&
            pick_target(operation, parameter))
            points.push_back(arguments.point(parameter.name));
    return points;
}

}  // namespace

Positions places_of_edit(const LogEntry& entry) {
    const Arguments& arguments = entry.result ? entry.result->resolved : entry.edit.given;
    if (const auto* dabs = list_in(arguments, "dabs");
        dabs != nullptr && dabs->size() >= kDabNumbers)
        return {point_in(*dabs, dabs->size() / kDabNumbers / 2 * kDabNumbers)};
    Positions places;
    if (const auto* planes = list_in(arguments, "planes"))
        for (const PlannedOpening& opening : openings_in(*planes))
            places.push_back(opening.place.plane.point);
    if (!places.empty()) return places;
    return points_in(find_operation(entry.edit.operation), arguments);
}

}  // namespace vesselbench
