#include "workbench/window/case/edit_places.h"

#include "geometry/kernel/errors.h"
#include "workbench/case/checked_value.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/pick_target.h"

namespace vesselbench {

namespace {

/// Empty if there are none; a damaged project may hold anything in their place.
Records records_in(const Operation& operation, const Arguments& arguments, Meaning meaning) {
    const Parameter* parameter = parameter_of(operation, meaning);
    if (parameter == nullptr || !arguments.has(parameter->name)) return {};
    try {
        return std::get<Records>(checked_value(*parameter, arguments.values().at(parameter->name)));
    } catch (const UsageError&) {
        return {};
    }
}

/// Points that the user can pick.
Positions points_in(const Operation& operation, const Arguments& arguments) {
    Positions points;
    for (const Parameter& parameter : operation.parameters)
        if (parameter.type == ParameterType::Point && arguments.has(parameter.name) &&
            pick_target(parameter))
            points.push_back(arguments.point(parameter.name));
    return points;
}

}  // namespace

Positions places_of_edit(const LogEntry& entry) {
    const Operation* known = known_operation(entry.edit.operation);
    if (known == nullptr) return {};
    const Operation& operation = *known;
    const Arguments& arguments = entry.result ? entry.result->resolved : entry.edit.given;
    const Records stroke = records_in(operation, arguments, Meaning::Dabs);
    const std::vector<Arguments>& dabs = stroke.list();
    if (!dabs.empty()) return {dabs[dabs.size() / 2].point("point")};
    Positions places;
    for (const PlannedOpening& opening :
         openings_in(records_in(operation, arguments, Meaning::Planes)))
        places.push_back(opening.place.plane.point);
    return places.empty() ? points_in(operation, arguments) : places;
}

}  // namespace vesselbench
