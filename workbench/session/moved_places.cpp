#include "workbench/session/moved_places.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vesselbench {

namespace {

/// What parameters of Meaning::Unit can be resolved to [mm].
double millimetres_in(const std::string& unit) {
    static const std::map<std::string, double> lengths = {
        {"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"um", 1e-3}};
    const auto found = lengths.find(unit);
    return found == lengths.end() ? 1.0 : found->second;
}

bool is_place(const Parameter& parameter) {
    using enum Meaning;
    constexpr Meaning kPlaces[] = {Place, Tip, Branch, Inlet, Seed, Box};
    return parameter.type == ParameterType::Records ||
           (parameter.unit == "mm" && std::ranges::count(kPlaces, parameter.meaning) > 0);
}

Records scaled(const Parameter& parameter, const Records& records, double factor) {
    std::vector<Arguments> moved = records.list();
    for (Arguments& record : moved)
        for (const Parameter& field : parameter.fields) {
            if (field.unit != "mm" || !record.has(field.name)) continue;
            if (field.type == ParameterType::Point)
                record.set(field.name, Vec3(factor * record.point(field.name)));
            else
                record.set(field.name, factor * record.real(field.name));
        }
    return Records(std::move(moved));
}

}  // namespace

std::optional<double> unit_factor(const Operation& operation, const Arguments& resolved_before,
                                  const Arguments& resolved_now) {
    const Parameter* unit = parameter_of(operation, Meaning::Unit);
    if (unit == nullptr || !resolved_before.has(unit->name) || !resolved_now.has(unit->name))
        return std::nullopt;
    const std::string &before = resolved_before.text(unit->name),
                      &now = resolved_now.text(unit->name);
    if (before == now) return std::nullopt;
    return millimetres_in(now) / millimetres_in(before);
}

Arguments with_scaled_places(const Operation& operation, Arguments given, double factor) {
    for (const Parameter& parameter : operation.parameters) {
        if (!is_place(parameter) || !given.has(parameter.name)) continue;
        const Value& value = given.values().at(parameter.name);
        if (const Vec3* point = std::get_if<Vec3>(&value)) {
            given.set(parameter.name, Vec3(factor * *point));
        } else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
            std::vector<double> numbers = *list;
            for (double& number : numbers) number *= factor;
            given.set(parameter.name, std::move(numbers));
        } else if (const auto* records = std::get_if<Records>(&value)) {
            given.set(parameter.name, scaled(parameter, *records, factor));
        }
    }
    return given;
}

std::vector<std::string> given_sizes(const Operation& operation, const Arguments& given) {
    std::vector<std::string> names;
    for (const Parameter& parameter : operation.parameters)
        if (parameter.unit == "mm" && !is_place(parameter) && given.has(parameter.name))
            names.push_back(parameter.name);
    return names;
}

}  // namespace vesselbench
