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

    Json operator()(const Records& records) const {
        Json list = Json::array();
        for (const Arguments& record : records.list()) list.push_back(to_json(record));
        return list;
    }
};

std::string shown(const Json& json) {
    return shortened(printable(text_from_json(json)));
}

std::vector<double> numbers_in(const std::string& called, const Json& json) {
    std::vector<double> numbers;
    for (const Json& entry : json) {
        if (!entry.is_number())
            throw UsageError(called + " = " + shown(json) +
                             " contains something that is not a number");
        numbers.push_back(entry.get<double>());
    }
    return numbers;
}

Records records_in(const std::string& called, const Json& json) {
    std::vector<Arguments> records;
    for (const Json& entry : json) {
        const std::string record = called + ", record " + std::to_string(records.size() + 1);
        if (!entry.is_object())
            throw UsageError(record + " = " + shown(entry) + " must be an object of its fields");
        Arguments& fields = records.emplace_back();
        for (const auto& [name, value] : entry.items())
            fields.set(name, value_from_json(
                                 record + ", field '" + shortened(printable(name)) + "'", value));
    }
    return Records(std::move(records));
}

}  // namespace

nlohmann::ordered_json to_json(const Value& value) {
    return std::visit(JsonOf{}, value);
}

Value value_from_json(const std::string& called, const nlohmann::ordered_json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_unsigned() && !std::in_range<std::int64_t>(json.get<std::uint64_t>()))
        return json.get<double>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_array() && !json.empty() && json.front().is_object())
        return records_in(called, json);
    if (json.is_array()) return numbers_in(called, json);
    throw UsageError(called + " = " + shown(json) +
                     " must be a number, a text, true, false, or a list of numbers or records");
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
    for (const auto& [name, json] : object.items())
        given.set(name, value_from_json("parameter '" + name + "'", json));
    return given_arguments(operation, given);
}

}  // namespace vesselbench
