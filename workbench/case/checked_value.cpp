#include "workbench/case/checked_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/case/parameter_texts.h"
#include "workbench/case/record_values.h"

namespace vesselbench {

namespace {

/// The names in a text, as far as they have to follow the grammar of names.
std::vector<std::string> names_in(const Parameter& parameter, const std::string& text) {
    if (parameter.meaning == Meaning::Name) return {text};
    if (parameter.meaning != Meaning::Names && parameter.meaning != Meaning::Openings) return {};
    std::vector<std::string> names;
    std::istringstream list(text);
    for (std::string entry; std::getline(list, entry, ',');) names.push_back(entry);
    return names;
}

[[noreturn]] void refuse(const Parameter& parameter, const std::string& called,
                         const std::string& text) {
    const std::string near = parameter.type == ParameterType::Choice
                                 ? did_you_mean(text, parameter.choices)
                                 : std::string();
    throw UsageError(called + " = '" + shortened(printable(text)) +
                     "' is not allowed: it must be " + allowed_text(parameter) + near);
}

template <class Number>
std::optional<Number> number_from(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

std::optional<std::vector<double>> numbers_from(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const auto number = number_from<double>(text.substr(begin, comma - begin));
        if (!number) return std::nullopt;
        numbers.push_back(*number);
        begin = comma + 1;
    }
    return numbers;
}

std::optional<Value> value_from_text(const Parameter& parameter, const std::string& text) {
    const auto value_of = [](const auto& number) {
        return number ? std::optional<Value>(*number) : std::nullopt;
    };
    switch (parameter.type) {
        case ParameterType::Flag:
            if (text == "true") return Value(true);
            if (text == "false") return Value(false);
            return std::nullopt;
        case ParameterType::Integer:
            return value_of(number_from<std::int64_t>(text));
        case ParameterType::Real:
            if (std::ranges::count(parameter.choices, text) > 0) return Value(text);
            return value_of(number_from<double>(text));
        case ParameterType::List:
            if (text.empty()) return Value(std::vector<double>());  // as to_text writes it
            return value_of(numbers_from(text));
        case ParameterType::Point: {
            if (std::ranges::count(parameter.choices, text) > 0) return Value(text);
            const auto numbers = numbers_from(text);
            if (!numbers || numbers->size() != 3) return std::nullopt;
            return Value(Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]));
        }
        case ParameterType::File:
            if (text.empty()) return std::nullopt;
            return Value(text);
        case ParameterType::Choice:
        case ParameterType::Text:
            return Value(text);
        case ParameterType::Records:
            break;
    }
    return std::nullopt;
}

std::vector<double> numbers_of(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return {static_cast<double>(*whole)};
    if (const auto* real = std::get_if<double>(&value)) return {*real};
    if (const auto* p = std::get_if<Vec3>(&value)) return {p->x(), p->y(), p->z()};
    if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
    return {};
}

void require_known_fields(const Parameter& parameter, const Arguments& record,
                          const std::string& called) {
    std::vector<std::string> names;
    for (const Parameter& field : parameter.fields) names.push_back(field.name);
    for (const auto& [name, value] : record.values())
        if (std::ranges::count(names, name) == 0)
            throw UsageError(called + " has no field '" + shortened(printable(name)) + "'" +
                             did_you_mean(name, names) + " (its fields are " + joined(names) + ")");
}

Arguments checked_record(const Parameter& parameter, const Arguments& record,
                         const std::string& called) {
    require_known_fields(parameter, record, called);
    Arguments checked;
    for (const Parameter& field : parameter.fields) {
        const std::string field_called = called + ", field '" + field.name + "'";
        const auto given = record.values().find(field.name);
        if (given != record.values().end())
            checked.set(field.name, checked_value(field, given->second, field_called));
        else if (field.default_value)
            checked.set(field.name, checked_value(field, *field.default_value, field_called));
        else if (field.required)
            throw UsageError(field_called + " is required: " + field.help);
    }
    return checked;
}

std::optional<Records> checked_records(const Parameter& parameter, const Value& value,
                                       const std::string& called) {
    const std::optional<Records> given = records_from(parameter, value, called);
    if (!given) return std::nullopt;
    std::vector<Arguments> checked;
    for (const Arguments& record : given->list())
        checked.push_back(checked_record(
            parameter, record, called + ", record " + std::to_string(checked.size() + 1)));
    return Records(std::move(checked));
}

std::optional<Value> in_type(const Parameter& parameter, const Value& value,
                             const std::string& called) {
    if (parameter.type == ParameterType::Records) return checked_records(parameter, value, called);
    if (std::holds_alternative<Records>(value)) return std::nullopt;
    if (const auto* text = std::get_if<std::string>(&value))
        return value_from_text(parameter, *text);
    if (std::holds_alternative<bool>(value))
        return parameter.type == ParameterType::Flag ? std::optional(value) : std::nullopt;
    const std::vector<double> numbers = numbers_of(value);
    switch (parameter.type) {
        case ParameterType::Integer:
            if (numbers.size() != 1 || numbers[0] != std::floor(numbers[0]) ||
                std::abs(numbers[0]) > 9e15)
                return std::nullopt;
            return Value(static_cast<std::int64_t>(numbers[0]));
        case ParameterType::Real:
            return numbers.size() == 1 ? std::optional<Value>(numbers[0]) : std::nullopt;
        case ParameterType::Point:
            if (numbers.size() != 3) return std::nullopt;
            return Value(Vec3(numbers[0], numbers[1], numbers[2]));
        case ParameterType::List:
            return Value(numbers);
        case ParameterType::Text:
            return Value(to_text(value));
        default:
            return std::nullopt;
    }
}

bool in_range(const Parameter& parameter, const Value& value) {
    if (parameter.type == ParameterType::Choice)
        return std::ranges::count(parameter.choices, std::get<std::string>(value)) > 0;
    if (const auto* text = std::get_if<std::string>(&value))
        return std::ranges::all_of(names_in(parameter, *text), is_plain_name);
    return std::ranges::all_of(numbers_of(value), [&](double number) {
        return std::isfinite(number) && number <= parameter.maximum &&
               (parameter.above_minimum ? number > parameter.minimum : number >= parameter.minimum);
    });
}

}  // namespace

Value checked_value(const Parameter& parameter, const Value& value) {
    return checked_value(parameter, value, "parameter '" + parameter.name + "'");
}

Value checked_value(const Parameter& parameter, const Value& value, const std::string& called) {
    const auto* text = std::get_if<std::string>(&value);
    if (text != nullptr && parameter.type != ParameterType::File)
        require_utf8(*text, called + " =");
    const std::optional<Value> typed = in_type(parameter, value, called);
    if (!typed || !in_range(parameter, *typed)) refuse(parameter, called, to_text(value));
    return *typed;
}

}  // namespace vesselbench
