#include "workbench/case/record_values.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"

namespace vesselbench {

namespace {

/// Between the values of a flat list, as "1,2,3" and "inlet:left,outlet:right".
constexpr const char* kSeparators = ",:";

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// The values of a flat list that a field takes.
std::size_t parts_in(const Parameter& field) {
    return field.type == ParameterType::Point ? 3 : 1;
}

/// Lists of numbers have a choice's index in place of its name.
std::string choice_of(const Parameter& field, const std::string& part) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    const bool is_index = error == std::errc{} && end == part.data() + part.size();
    return is_index && index < field.choices.size() ? field.choices[index] : part;
}

Arguments flat_record(const Parameter& parameter, std::span<const std::string> parts) {
    Arguments record;
    for (const Parameter& field : parameter.fields) {
        const auto own = parts.first(parts_in(field));
        parts = parts.subspan(own.size());
        record.set(field.name, field.type == ParameterType::Choice ? choice_of(field, own[0])
                                                                   : joined(own, ","));
    }
    return record;
}

std::optional<Records> flat_records(const Parameter& parameter, const std::string& text) {
    std::size_t width = 0;
    for (const Parameter& field : parameter.fields) width += parts_in(field);
    const std::vector<std::string> parts = parts_of(text);
    if (width == 0 || parts.size() % width != 0) return std::nullopt;
    std::vector<Arguments> records;
    for (std::size_t i = 0; i < parts.size(); i += width)
        records.push_back(flat_record(parameter, std::span(parts).subspan(i, width)));
    return Records(std::move(records));
}

Value value_in_text(const std::string& text, const std::string& called) {
    try {
        return value_from_json(called, json_from_text(text, called, kLargestStoredJson));
    } catch (const InvalidInput& error) {
        throw UsageError(error.what());
    }
}

}  // namespace

std::optional<Records> records_from(const Parameter& parameter, const Value& value,
                                    const std::string& called) {
    if (const auto* records = std::get_if<Records>(&value)) return *records;
    if (std::holds_alternative<bool>(value)) return std::nullopt;
    const std::string text = to_text(value);
    if (!text.starts_with('[')) return flat_records(parameter, text);
    const Value read = value_in_text(text, called);
    if (const auto* records = std::get_if<Records>(&read)) return *records;
    return flat_records(parameter, to_text(read));
}

}  // namespace vesselbench
