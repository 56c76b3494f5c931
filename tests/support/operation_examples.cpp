#include "tests/support/operation_examples.h"

#include <algorithm>
#include <optional>

namespace vesselbench::test {

namespace {

/// None: this ground has nothing of the parameter's meaning.
std::optional<Value> found_on(const ExampleGround& ground, const Operation& operation,
                              const Parameter& parameter) {
    if (parameter.type == ParameterType::File) {
        const bool is_input = parameter.name == "file" && operation.recipe.loads;
        const std::string& file = is_input ? ground.files.at(*operation.recipe.loads) : ground.mask;
        return file.empty() ? std::nullopt : std::optional<Value>(file);
    }
    switch (parameter.meaning) {
        case Meaning::Place:
            return ground.wall;
        case Meaning::Tip:
            return ground.end;
        case Meaning::Branch:
            return ground.branch;
        case Meaning::Name:
            return std::string("bone");
        default:
            return std::nullopt;
    }
}

/// Lengths of this vessel.
void add_scaled(const Operation& operation, const Arguments& values, double radius,
                Arguments& all) {
    for (const auto& [name, value] : values.values()) {
        const double* number = std::get_if<double>(&value);
        const bool is_length = number && find_parameter(operation, name).unit == "mm";
        all.set(name, is_length ? Value(radius * *number) : value);
    }
}

}  // namespace

Arguments example_arguments(const Operation& operation, const ExampleGround& ground) {
    Arguments all;
    std::size_t places =
        0;  // several of one operation are apart along the vessel, which is along z
    for (const Parameter& parameter : operation.parameters) {
        if (!parameter.required && parameter.type != ParameterType::File &&
            std::ranges::count(operation.example.placed, parameter.name) == 0)
            continue;
        auto value = found_on(ground, operation, parameter);
        if (value && parameter.meaning == Meaning::Place) {
            constexpr double kApart[] = {0.0, -1.0, 1.0};
            value = Vec3(ground.wall + ground.radius * kApart[places++ % 3] * Vec3::UnitZ());
        }
        if (value) all.set(parameter.name, *value);
    }
    add_scaled(operation, operation.example.given, ground.radius, all);
    return all;
}

Arguments example_changes(const Operation& operation, const ExampleGround& ground) {
    Arguments all;
    add_scaled(operation, operation.example.changed, ground.radius, all);
    return all;
}

}  // namespace vesselbench::test
