#include "workbench/window/model/edit_places.h"

#include "workbench/operations/table.h"
#include "workbench/window/model/pick_target.h"

namespace vesselbench {

namespace {

constexpr std::size_t kNumbers = 10;  ///< of a dab in `dabs`, and of an opening in `planes`
constexpr std::size_t kPlanePoint = 3;

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
    if (const auto* dabs = list_in(arguments, "dabs"); dabs != nullptr && dabs->size() >= kNumbers)
        return {point_in(*dabs, dabs->size() / kNumbers / 2 * kNumbers)};
    Positions places;
    if (const auto* planes = list_in(arguments, "planes"))
        for (std::size_t i = 0; i + kNumbers <= planes->size(); i += kNumbers)
            places.push_back(point_in(*planes, i + kPlanePoint));
    if (!places.empty()) return places;
    const Operation* operation = known_operation(entry.edit.operation);
    return operation == nullptr ? places : points_in(*operation, arguments);
}

}  // namespace vesselbench
