#include <cmath>
#include <iostream>
#include <map>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/operation.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string to_string(ParameterType type) {
    switch (type) {
        case ParameterType::Flag:
            return "flag";
        case ParameterType::Integer:
            return "integer";
        case ParameterType::Real:
            return "real";
        case ParameterType::Text:
            return "text";
        case ParameterType::Choice:
            return "choice";
        case ParameterType::Point:
            return "point";
        case ParameterType::List:
            return "list";
        case ParameterType::File:
            return "file";
    }
    return "";
}

Json json_of(const Parameter& parameter) {
    Json json = {{"name", parameter.name},
                 {"type", to_string(parameter.type)},
                 {"unit", parameter.unit},
                 {"required", parameter.required}};
    json["default"] = parameter.default_value ? to_json(*parameter.default_value) : Json();
    if (std::isfinite(parameter.minimum)) {
        json["minimum"] = parameter.minimum;
        json["minimum_allowed"] = !parameter.above_minimum;
    }
    if (std::isfinite(parameter.maximum)) json["maximum"] = parameter.maximum;
    if (!parameter.choices.empty()) json["choices"] = parameter.choices;
    if (parameter.only_with) json["only_with"] = to_string(*parameter.only_with);
    json["help"] = parameter.help;
    return json;
}

Json json_of(const Operation& operation) {
    Json json = {{"name", operation.name},
                 {"step", to_string(operation.usual_step)},
                 {"allowed_steps", step_names(operation.allowed)},
                 {"summary", operation.summary},
                 {"thesis", operation.thesis},
                 {"parameters", Json::array()}};
    for (const Parameter& parameter : operation.parameters)
        json["parameters"].push_back(json_of(parameter));
    return json;
}

/// "0 ... 1", ">= 1"; nothing without bounds.
std::string bounds_text(const Parameter& parameter) {
    const bool below = std::isfinite(parameter.minimum), above = std::isfinite(parameter.maximum);
    const std::string from = to_text(Value(parameter.minimum));
    const std::string to = to_text(Value(parameter.maximum));
    if (below && above) return (parameter.above_minimum ? "> " : "") + from + " ... " + to;
    if (below) return (parameter.above_minimum ? "> " : ">= ") + from;
    return above ? "<= " + to : "";
}

std::string range_text(const Parameter& parameter) {
    const std::string bounds = bounds_text(parameter);
    const std::string bounded = bounds.empty() ? "" : ", " + bounds;
    switch (parameter.type) {
        case ParameterType::Choice:
            return joined(parameter.choices, "|");
        case ParameterType::Flag:
            return "true|false";
        case ParameterType::Point:
            return "x,y,z" + bounded;
        case ParameterType::List:
            return "a,b,..." + bounded;
        case ParameterType::Integer:
        case ParameterType::Real:
            return bounds.empty() ? "number" : bounds;
        default:
            return to_string(parameter.type);
    }
}

std::string unit_text(const Parameter& parameter) {
    return parameter.unit.empty() || parameter.unit == "-" ? "" : "[" + parameter.unit + "]";
}

std::string default_text(const Parameter& parameter) {
    if (parameter.required) return "needed";
    if (!parameter.default_value) return "automatic";
    const std::string text = to_text(*parameter.default_value);
    return text.empty() ? "none" : text;
}

std::vector<std::string> parameter_row(const Parameter& parameter) {
    const std::string unit = unit_text(parameter);
    const std::string condition =
        parameter.only_with ? "with " + to_string(*parameter.only_with) + ": " : "";
    return {parameter.name, default_text(parameter),
            range_text(parameter) + (unit.empty() ? "" : " " + unit), condition + parameter.help};
}

void print_one(const Operation& operation) {
    std::cout << operation.name << ": " << operation.summary << "\n\n";
    std::cout << "steps: " << joined(step_names(operation.allowed)) << " (usually "
              << to_string(operation.usual_step) << ")\n";
    if (!operation.thesis.empty()) std::cout << "thesis: " << operation.thesis << "\n";
    std::cout << "\n";
    if (operation.parameters.empty()) {
        std::cout << "It has no parameters.\n";
        return;
    }
    std::vector<std::vector<std::string>> rows = {{"parameter", "default", "values", "meaning"}};
    for (const Parameter& parameter : operation.parameters)
        rows.push_back(parameter_row(parameter));
    std::cout << as_columns(rows);
}

void print_all() {
    std::vector<std::vector<std::string>> rows = {{"step", "operation", "what it does"}};
    for (const Operation& operation : operation_table())
        rows.push_back({to_string(operation.usual_step), operation.name, operation.summary});
    std::cout << as_columns(rows)
              << "\nSee 'vesselbench operations NAME' for an operation and its parameters.\n";
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text) result += letter == '|' ? "\\|" : std::string(1, letter);
    return result;
}

void print_markdown(const Operation& operation) {
    std::cout << "\n### " << operation.name << "\n\n" << operation.summary << "\n\n";
    std::cout << "Steps: " << joined(step_names(operation.allowed)) << ".";
    if (!operation.thesis.empty()) std::cout << " Thesis: " << operation.thesis << ".";
    std::cout << "\n";
    if (operation.parameters.empty()) return;
    std::cout << "\n| parameter | default | values | meaning |\n|---|---|---|---|\n";
    for (const Parameter& parameter : operation.parameters) {
        std::cout << "|";
        for (const std::string& cell : parameter_row(parameter))
            std::cout << " " << escaped(cell) << " |";
        std::cout << "\n";
    }
}

void print_page() {
    std::cout << "# Operations\n\nThis page is generated by `vesselbench operations --markdown`; "
                 "`scripts/docs` updates it.\n\nAn edit of a project is one operation with its "
                 "arguments: `vesselbench apply PROJECT OPERATION parameter=value ...`.\nA "
                 "parameter that is not given takes its default. If the default is *automatic*, "
                 "the operation decides by itself and\nstores its decision with the edit, so that "
                 "a replay repeats it.\n";
    std::string step;
    for (const Operation& operation : operation_table()) {
        if (std::exchange(step, to_string(operation.usual_step)) != to_string(operation.usual_step))
            std::cout << "\n## Step " << static_cast<int>(operation.usual_step) << ": " << step
                      << "\n";
        print_markdown(operation);
    }
}

}  // namespace

void list_operations(const OperationsOptions& options) {
    if (options.markdown) return print_page();
    if (!options.name.empty()) {
        const Operation& operation = find_operation(options.name);
        if (options.json)
            std::cout << json_of(operation).dump(2) << "\n";
        else
            print_one(operation);
        return;
    }
    if (!options.json) return print_all();
    Json all = Json::array();
    for (const Operation& operation : operation_table()) all.push_back(json_of(operation));
    std::cout << Json({{"operations", all}}).dump(2) << "\n";
}

}  // namespace vesselbench
