#include "workbench/case/parameter_texts.h"

#include <cmath>

#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// "0 ... 1", ">= 1"; nothing without bounds.
std::string bounds_text(const Parameter& parameter) {
    const bool below = std::isfinite(parameter.minimum), above = std::isfinite(parameter.maximum);
    const std::string from = to_text(Value(parameter.minimum));
    const std::string to = to_text(Value(parameter.maximum));
    if (below && above) return (parameter.above_minimum ? "> " : "") + from + " ... " + to;
    if (below) return (parameter.above_minimum ? "> " : ">= ") + from;
    return above ? "<= " + to : "";
}

/// [{"place": ..., "way": ...}, ...]
std::string record_text(const Parameter& parameter) {
    std::string fields;
    for (const Parameter& field : parameter.fields)
        fields += (fields.empty() ? "\"" : ", \"") + field.name + "\": ...";
    return "[{" + fields + "}, ...]";
}

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

}  // namespace

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
        case ParameterType::Records:
            return "records";
        case ParameterType::File:
            return "file";
    }
    return "";
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
            return "x,y,z" + bounded +
                   (parameter.choices.empty() ? "" : "|" + joined(parameter.choices, "|"));
        case ParameterType::List:
            return "a,b,..." + bounded;
        case ParameterType::Records:
            return record_text(parameter);
        case ParameterType::Integer:
        case ParameterType::Real:
            return (bounds.empty() ? "number" : bounds) +
                   (parameter.choices.empty() ? "" : "|" + joined(parameter.choices, "|"));
        default:
            return to_string(parameter.type);
    }
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

std::string unit_text(const Parameter& parameter) {
    return parameter.unit.empty() || parameter.unit == "-" ? "" : "[" + parameter.unit + "]";
}

std::string default_text(const Parameter& parameter) {
    if (parameter.required) return "required";
    if (!parameter.default_value) return "automatic";
    const std::string text = to_text(*parameter.default_value);
    return text.empty() ? "none" : text;
}

}  // namespace vesselbench
