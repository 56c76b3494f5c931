#include "workbench/case/arguments_json.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_text.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

struct JsonOf {
    Json operator()(bool flag) const { return flag; }

    Json operator()(std::int64_t number) const { return number; }

    Json operator()(double number) const { return number; }

    Json operator()(const std::string& text) const { return text; }

    Json operator()(const Vec3& p) const { return point_json(p); }

    Json operator()(const std::vector<double>& list) const { return list; }
};

std::string shown(const Json& json) {
    return shortened(printable(text_from_json(json)));
}

Value plain_value(const std::string& name, const Json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_unsigned() && !std::in_range<std::int64_t>(json.get<std::uint64_t>()))
        return json.get<double>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_array()) {
        std::vector<double> numbers;
        for (const Json& entry : json) {
            if (!entry.is_number())
                throw UsageError("parameter '" + name + "' = " + shown(json) +
                                 " contains something that is not a number");
            numbers.push_back(entry.get<double>());
        }
        return numbers;
    }
    throw UsageError("parameter '" + name + "' = " + shown(json) +
                     " must be a number, a text, true, false or a list of numbers");
}

}  // namespace

nlohmann::ordered_json to_json(const Value& value) {
    return std::visit(JsonOf{}, value);
}

nlohmann::ordered_json to_json(const Arguments& arguments) {
    Json object = Json::object();
    for (const auto& [name, value] : arguments.values()) object[name] = to_json(value);
    return object;
}

GivenArguments arguments_from_json(const Operation& operation,
                                   const nlohmann::ordered_json& object) {
    if (!object.is_object())
        throw UsageError("the arguments of " + operation.name + " are not a JSON object");
    Arguments given;
    for (const auto& [name, json] : object.items()) given.set(name, plain_value(name, json));
    return given_arguments(operation, given);
}

}  // namespace vesselbench
