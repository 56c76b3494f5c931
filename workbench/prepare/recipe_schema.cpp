#include "workbench/prepare/recipe_schema.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "workbench/case/parameter_texts.h"
#include "workbench/case/purposes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/entry_reader.h"
#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

// Values may be written as the command line has them, "0.5" and "1,2,3".
constexpr const char* kNumber = R"(^-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$)";
constexpr const char* kNumbers = R"(^(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(,|$))*$)";

/// \param part of the definitions: "entry"
Json reference(const std::string& part) {
    return {{"$ref", "#/$defs/" + part}};
}

Json one_of(Json words) {
    Json json = Json::object();
    json["enum"] = std::move(words);
    return json;
}

Json of_type(const char* type) {
    Json json = Json::object();
    json["type"] = type;
    return json;
}

Json number(const Parameter& parameter, const char* type) {
    Json json = {{"type", type}};
    if (std::isfinite(parameter.minimum))
        json[parameter.above_minimum ? "exclusiveMinimum" : "minimum"] = parameter.minimum;
    if (std::isfinite(parameter.maximum)) json["maximum"] = parameter.maximum;
    return json;
}

Json text(const char* pattern = nullptr) {
    Json json = of_type("string");
    if (pattern != nullptr) json["pattern"] = pattern;
    return json;
}

Json list(Json items) {
    return {{"type", "array"}, {"items", std::move(items)}};
}

Json of_parameters(const std::vector<Parameter>& parameters);

/// The forms that a value may have.
std::vector<Json> forms_of(const Parameter& parameter) {
    switch (parameter.type) {
        case ParameterType::Flag:
            return {of_type("boolean"), one_of(Json::array({"true", "false"}))};
        case ParameterType::Integer:
            return {number(parameter, "integer"), text(kNumber)};
        case ParameterType::Real:
            return {number(parameter, "number"), text(kNumber)};
        case ParameterType::Point: {
            Json point = list(number(parameter, "number"));
            point["minItems"] = point["maxItems"] = 3;
            return {point, text(kNumbers)};
        }
        case ParameterType::List:
            return {list(number(parameter, "number")), number(parameter, "number"), text(kNumbers)};
        case ParameterType::Records: {
            Json record = of_parameters(parameter.fields);
            for (const Parameter& field : parameter.fields)
                if (field.required) record["required"].push_back(field.name);
            return {list(record), list(of_type("number")), text()};
        }
        case ParameterType::Text:
            return {text(), of_type("number"), list(of_type("number"))};
        case ParameterType::Choice:
            return {};
        case ParameterType::File:
            return {text(".")};
    }
    return {};
}

/// True for a choice that may be "$purpose".
bool takes_purpose(const Parameter& parameter) {
    return std::ranges::all_of(purpose_names(), [&](const std::string& name) {
        return std::ranges::count(parameter.choices, name) > 0;
    });
}

/// True for a choice that may be "$mask".
bool takes_mask(const Parameter& parameter) {
    return parameter.name == "method" && std::ranges::count(parameter.choices, "wall") > 0;
}

Json of_parameter(const Parameter& parameter) {
    std::vector<Json> forms = forms_of(parameter);
    if (!parameter.choices.empty()) {
        Json words = parameter.choices;
        if (takes_purpose(parameter)) words.push_back("$purpose");
        if (takes_mask(parameter)) words.push_back("$mask");
        forms.insert(forms.begin(), one_of(std::move(words)));
    }
    Json json = forms.size() == 1 ? forms.front() : Json{{"anyOf", forms}};
    const std::string unit = unit_text(parameter);
    const std::string condition =
        parameter.only_with ? "with " + to_string(*parameter.only_with) + ": " : "";
    json["description"] = condition + parameter.help + (unit.empty() ? "" : " " + unit);
    if (parameter.default_value) json["default"] = to_json(*parameter.default_value);
    return json;
}

Json of_parameters(const std::vector<Parameter>& parameters) {
    Json properties = Json::object();
    for (const Parameter& parameter : parameters)
        properties[parameter.name] = of_parameter(parameter);
    return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

Json operation_names() {
    Json names = Json::array();
    for (const Operation& operation : operation_table()) names.push_back(operation.name);
    return names;
}

/// What holds of the values of `keys` if the operation is this one.
Json if_operation(const Operation& operation, const std::vector<std::string>& keys, bool steps) {
    Json properties = Json::object();
    if (steps) properties["step"] = one_of(step_names(operation.allowed));
    for (const std::string& key : keys) properties[key] = reference(operation.name);
    const Json is_this = {{"properties", {{"operation", {{"const", operation.name}}}}},
                          {"required", Json::array({"operation"})}};
    return {{"if", is_this}, {"then", {{"properties", properties}}}};
}

/// An object that names an operation. \param keys of arguments
Json of_operation(Json properties, const std::vector<std::string>& keys) {
    Json each = Json::array();
    for (const Operation& operation : operation_table())
        each.push_back(if_operation(operation, keys, properties.contains("step")));
    Json all = {{"operation", one_of(operation_names())}};
    for (const std::string& key : keys) all[key] = of_type("object");
    all.update(properties);
    return {{"type", "object"},
            {"required", Json::array({"operation"})},
            {"properties", all},
            {"additionalProperties", false},
            {"allOf", each}};
}

Json described(const char* description, Json json) {
    json["description"] = description;
    return json;
}

Json step_schema() {
    return described("step of the edit; default: the operation's usual one", of_type("string"));
}

Json when_schema() {
    Json words = Json::array();
    for (const std::string& word : use_words()) {
        words.push_back(word);
        words.push_back("no-" + word);
    }
    const Json word = one_of(words);
    return described("used only if all of these words hold",
                     {{"anyOf", Json::array({word, list(word)})}});
}

Json entry_schema() {
    const Json made = of_operation(Json::object(), {"arguments"});
    return of_operation(
        {{"step", step_schema()},
         {"optional", described("if it cannot be done, the recipe continues with a warning",
                                of_type("boolean"))},
         {"unless_closed",
          described("skipped if the surface has no border at that point", of_type("boolean"))},
         {"unless_made", described("skipped if such an edit, or one of them, was made",
                                   {{"anyOf", Json::array({made, list(made)})}})},
         {"when", reference("when")}},
        {"arguments", "otherwise"});
}

Json gate_schema() {
    return {{"type", "object"},
            {"required", Json::array({"require"})},
            {"properties",
             {{"require", described("reviewers who have to accept every edit first",
                                    text("^accepted(=0*[1-9][0-9]*)?$"))},
              {"when", reference("when")}}},
            {"additionalProperties", false}};
}

Json document_schema() {
    const Json purpose = one_of(purpose_names());
    return {{"type", "object"},
            {"properties",
             {{"$schema", text()},
              {"title", text()},
              {"description", text()},
              {"for", described("purposes that the recipe is made for",
                                {{"anyOf", Json::array({purpose, list(purpose)})}})},
              {"on", described("a bundled recipe that this one is a change of",
                               one_of(bundled_recipe_names()))},
              {"change", described("arguments to replace in the entries of that recipe",
                                   list(of_operation({{"step", step_schema()}}, {"arguments"})))},
              {"entries", list(reference("entry"))}}},
            {"additionalProperties", false},
            {"dependentRequired", {{"change", Json::array({"on"})}}},
            {"anyOf", Json::array({{{"required", Json::array({"entries"})}},
                                   {{"required", Json::array({"on"})}}})}};
}

}  // namespace

Json recipe_schema() {
    Json definitions = {{"entry",
                         {{"if", {{"type", "object"}, {"required", Json::array({"require"})}}},
                          {"then", gate_schema()},
                          {"else", entry_schema()}}},
                        {"when", when_schema()}};
    for (const Operation& operation : operation_table())
        definitions[operation.name] =
            described(operation.summary.c_str(), of_parameters(operation.parameters));
    return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", "Recipe of vesselbench"},
            {"description",
             "What vesselbench prepare --recipe follows: operations with their "
             "arguments, in order. Lengths in mm."},
            {"if", {{"type", "array"}}},
            {"then", list(reference("entry"))},
            {"else", document_schema()},
            {"$defs", definitions}};
}

}  // namespace vesselbench
