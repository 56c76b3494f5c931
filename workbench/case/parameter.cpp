#include "workbench/case/parameter.h"

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

std::string allowed_range(const Parameter& parameter) {
    const std::string unit =
        parameter.unit.empty() || parameter.unit == "-" ? "" : " " + parameter.unit;
    const bool below = std::isfinite(parameter.minimum), above = std::isfinite(parameter.maximum);
    const std::string from = to_text(Value(parameter.minimum));
    const std::string to = to_text(Value(parameter.maximum));
    if (below && above)
        return (parameter.above_minimum ? "above " + from + " and at most " + to
                                        : from + " to " + to) +
               unit;
    if (below) return (parameter.above_minimum ? "above " : "at least ") + from + unit;
    if (above) return "at most " + to + unit;
    return "";
}

/// The names in a text, as far as they have to follow the grammar of names.
std::vector<std::string> names_in(const Parameter& parameter, const std::string& text) {
    if (parameter.meaning == Meaning::Name) return {text};
    if (parameter.meaning != Meaning::Names && parameter.meaning != Meaning::Openings) return {};
    std::vector<std::string> names;
    std::istringstream list(text);
    for (std::string entry; std::getline(list, entry, ',');) names.push_back(entry);
    return names;
}

std::string wanted_text(const Parameter& parameter) {
    switch (parameter.meaning) {
        case Meaning::Name:
            return "a name of " + plain_name_rule();
        case Meaning::Names:
        case Meaning::Openings:
            return "names of " + plain_name_rule() + ", separated by commas";
        default:
            return "a text";
    }
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

std::string to_string(const Condition& condition) {
    std::string text = condition.parameter + (condition.values.empty() ? "" : "=");
    for (std::size_t i = 0; i < condition.values.size(); ++i)
        text += (i > 0 ? " or " : "") + condition.values[i];
    return text;
}

bool holds(const Condition& condition, const Parameter& parameter, const std::string& text) {
    if (!condition.values.empty()) return std::ranges::count(condition.values, text) > 0;
    return !text.empty() && !(parameter.default_value && text == to_text(*parameter.default_value));
}

std::string allowed_text(const Parameter& parameter) {
    const std::string range = allowed_range(parameter);
    const std::string in_range = range.empty() ? "" : " (" + range + ")";
    switch (parameter.type) {
        case ParameterType::Flag:
            return "true or false";
        case ParameterType::Integer:
            return "an integer" + in_range;
        case ParameterType::Real:
            return "a number" + in_range +
                   (parameter.choices.empty() ? "" : ", or " + joined(parameter.choices));
        case ParameterType::Choice:
            return "one of " + joined(parameter.choices);
        case ParameterType::Point:
            return "three numbers x,y,z" + in_range +
                   (parameter.choices.empty() ? "" : ", or " + joined(parameter.choices));
        case ParameterType::List:
            return "numbers separated by commas" + in_range;
        case ParameterType::Records:
            return "records as JSON, " + range_text(parameter) +
                   ", or the values of their fields one after the other, separated by commas";
        case ParameterType::Text:
            return wanted_text(parameter);
        case ParameterType::File:
            return "a file name";
    }
    return "";
}

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
