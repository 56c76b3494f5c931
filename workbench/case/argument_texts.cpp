#include "workbench/case/argument_texts.h"

#include <cmath>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Longer lists, and records such as the dabs of a stroke, are counted: a summary is read at a
/// glance.
constexpr std::size_t kMostListed = 8;

std::string short_text(const Value& value) {
    if (const auto* records = std::get_if<Records>(&value))
        return "(" + counted(records->list().size(), "record") + ")";
    const auto* list = std::get_if<std::vector<double>>(&value);
    if (list == nullptr || list->size() <= kMostListed) return to_text(value);
    return "(" + counted(list->size(), "number") + ")";
}

}  // namespace

GivenArguments arguments_from_texts(const Operation& operation,
                                    std::span<const std::string> texts) {
    GivenArguments arguments(operation);
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw UsageError("'" + text + "' is not of the form parameter=value");
        const std::string name = text.substr(0, equals);
        if (arguments->has(name))
            throw UsageError(operation.name + ": parameter '" + name + "' is given twice");
        arguments.set(name, text.substr(equals + 1));
    }
    return arguments;
}

std::string argument_summary(const Operation& operation, const Arguments& arguments) {
    std::string summary;
    for (const Parameter& parameter : operation.parameters) {
        const auto found = arguments.values().find(parameter.name);
        if (found == arguments.values().end() || found->second == parameter.default_value) continue;
        summary += (summary.empty() ? "" : " ") + parameter.name + "=" + short_text(found->second);
    }
    return summary;
}

double rounded_length(double millimetres) {
    constexpr double kStepsPerMm = 100.0;
    return std::round(millimetres * kStepsPerMm) / kStepsPerMm + 0.0;  // 0 instead of -0
}

Vec3 rounded_place(const Vec3& point) {
    return point.unaryExpr([](double part) { return rounded_length(part); });
}

}  // namespace vesselbench
