#include "workbench/window/features/live/parameter_drive.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr double kPixelsPerCount = 8.0;  ///< of an integer
constexpr double kRangeReach = 400.0;    ///< a drag by this goes through a bounded range [pixels]
constexpr double kFactorReach = 150.0;   ///< a drag by this changes other values by e [pixels]
constexpr double kStepsOfRange = 200.0;  ///< a bounded range is driven in so many steps
constexpr double kFirst = 0.01;          ///< of a value that begins at 0, per pixel
constexpr double kWidestRange = 10.0;    ///< wider ones are driven by factors

bool is_number(const FormField& field) {
    const ParameterType type = field.parameter->type;
    if (!field.active) return false;
    if (type == ParameterType::Real) return true;
    return type == ParameterType::Integer &&
           field.parameter->maximum - field.parameter->minimum > 1.0;
}

bool is_bounded(const Parameter& parameter) {
    return parameter.maximum - parameter.minimum <= kWidestRange;
}

double in_range(const Parameter& parameter, double value) {
    double least = parameter.minimum;
    if (parameter.above_minimum)
        least += is_bounded(parameter) ? (parameter.maximum - least) / kStepsOfRange
                                       : kFirst * std::max(1.0, std::abs(least));
    return std::clamp(value, least, parameter.maximum);
}

double scaled(double start, double pixels) {
    if (start == 0.0) return kFirst * std::max(pixels, 0.0);
    return three_digits(start * std::exp((start > 0.0 ? pixels : -pixels) / kFactorReach));
}

}  // namespace

std::vector<std::string> driven_parameters(const OperationForm& form) {
    std::vector<std::string> names;
    for (const FormField& field : form.fields())
        if (is_number(field)) names.push_back(field.parameter->name);
    return names;
}

DriveAxes usable_axes(const OperationForm& form, DriveAxes axes) {
    const std::vector<std::string> possible = driven_parameters(form);
    for (std::string* name : {&axes.across, &axes.up, &axes.shifted}) {
        if (std::ranges::count(possible, *name) > 0) continue;
        name->clear();
        for (const std::string& other : possible)
            if (other != axes.across && other != axes.up && other != axes.shifted) {
                *name = other;
                break;
            }
    }
    return axes;
}

double driven_value(const Parameter& parameter, double start, double pixels) {
    if (parameter.type == ParameterType::Integer)
        return in_range(parameter, start + std::round(pixels / kPixelsPerCount));
    if (pixels == 0.0) return start;
    if (!is_bounded(parameter)) return in_range(parameter, scaled(start, pixels));
    const double range = parameter.maximum - parameter.minimum, step = range / kStepsOfRange;
    const double value = start + pixels / kRangeReach * range;
    return in_range(parameter, std::round(value / step) * step);
}

double rounded_on_axis(double value, double from, double to) {
    if (!(to > from)) return from;
    const double rough = (to - from) / kStepsOfRange,
                 power = std::pow(10, std::floor(std::log10(rough)));
    double step = power;
    for (const double factor : {2.0, 5.0})
        if (factor * power <= rough * (1.0 + 1e-9)) step = factor * power;
    return std::clamp(std::round(value / step) * step, from, to);
}

std::string driven_text(const Parameter& parameter, double value) {
    if (parameter.type == ParameterType::Integer)
        return std::to_string(static_cast<long>(std::lround(value)));
    return formatted(value, "%.4g");
}

std::vector<FieldText> driven_texts(const OperationForm& before,
                                    const std::map<std::string, double>& starts,
                                    const DriveAxes& axes, const DriveReach& reach) {
    std::vector<FieldText> texts;
    const auto drive = [&](const std::string& name, double pixels) {
        if (name.empty()) return;
        const Parameter& parameter = *before.field(name).parameter;
        auto start = number_of(before, name);
        if (const auto found = starts.find(name); !start && found != starts.end())
            start = found->second;
        if (!start) return;
        const double value = driven_value(parameter, *start, pixels);
        const bool back = value == *start;
        texts.push_back({name, back ? before.field(name).text : driven_text(parameter, value)});
    };
    drive(axes.across, reach.across);
    drive(axes.up, reach.up);
    drive(axes.shifted, reach.shifted);
    return texts;
}

}  // namespace vesselbench
