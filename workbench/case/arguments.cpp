#include "workbench/case/arguments.h"

#include <charconv>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_text.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

const Value& value_of(const std::map<std::string, Value>& values, const std::string& name) {
    const auto found = values.find(name);
    if (found == values.end()) throw UsageError("parameter '" + name + "' is required");
    return found->second;
}

template <class T>
const T& typed(const std::map<std::string, Value>& values, const std::string& name,
               const char* type) {
    const Value& value = value_of(values, name);
    if (const T* held = std::get_if<T>(&value)) return *held;
    throw UsageError("parameter '" + name + "' = " + to_text(value) + " is not " + type);
}

std::string shortest(double number) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
    return {buffer, end};
}

struct TextOf {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }

    std::string operator()(std::int64_t number) const { return std::to_string(number); }

    std::string operator()(double number) const { return shortest(number); }

    std::string operator()(const std::string& text) const { return text; }

    std::string operator()(const Vec3& p) const {
        return shortest(p.x()) + "," + shortest(p.y()) + "," + shortest(p.z());
    }

    std::string operator()(const std::vector<double>& list) const {
        std::string text;
        for (const double number : list) text += (text.empty() ? "" : ",") + shortest(number);
        return text;
    }

    std::string operator()(const Records& records) const {
        return text_from_json(to_json(Value(records)));
    }
};

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

Records::Records(std::vector<Arguments> list)
    : list_(std::make_shared<const std::vector<Arguments>>(std::move(list))) {}

const std::vector<Arguments>& Records::list() const {
    static const std::vector<Arguments> none;
    return list_ ? *list_ : none;
}

bool Records::operator==(const Records& other) const {
    return list_ == other.list_ || list() == other.list();
}

std::string to_text(const Value& value) {
    return std::visit(TextOf{}, value);
}

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

bool Arguments::flag(const std::string& name) const {
    return typed<bool>(values_, name, "true or false");
}

std::int64_t Arguments::integer(const std::string& name) const {
    return typed<std::int64_t>(values_, name, "an integer");
}

double Arguments::real(const std::string& name) const {
    if (const auto* whole = std::get_if<std::int64_t>(&value_of(values_, name)))
        return static_cast<double>(*whole);
    return typed<double>(values_, name, "a number");
}

const std::string& Arguments::text(const std::string& name) const {
    return typed<std::string>(values_, name, "a text");
}

Vec3 Arguments::point(const std::string& name) const {
    return typed<Vec3>(values_, name, "x,y,z");
}

const std::vector<double>& Arguments::list(const std::string& name) const {
    return typed<std::vector<double>>(values_, name, "a list of numbers");
}

const Records& Arguments::records(const std::string& name) const {
    return typed<Records>(values_, name, "a list of records");
}

std::optional<double> Arguments::optional_real(const std::string& name) const {
    return has(name) ? std::optional(real(name)) : std::nullopt;
}

std::optional<Vec3> Arguments::optional_point(const std::string& name) const {
    return has(name) ? std::optional(point(name)) : std::nullopt;
}

std::optional<std::string> Arguments::optional_text(const std::string& name) const {
    return has(name) ? std::optional(text(name)) : std::nullopt;
}

bool Arguments::is_word(const std::string& name, std::string_view word) const {
    const auto value = values_.find(name);
    if (value == values_.end()) return false;
    const auto* text = std::get_if<std::string>(&value->second);
    return text && *text == word;
}

}  // namespace vesselbench
