#include "workbench/window/form/picked_text.h"

#include <algorithm>
#include <optional>

#include "geometry/kernel/errors.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/checked_value.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

namespace {

/// The numbers of a text of the command line; empty if it is none.
std::vector<double> numbers_of(const std::string& text) {
    static const Parameter list{.name = "numbers", .type = ParameterType::List, .help = {}};
    try {
        return std::get<std::vector<double>>(checked_value(list, Value(text)));
    } catch (const UsageError&) {
        return {};
    }
}

/// The points of three numbers each; empty if other numbers are left.
Positions points_of(const std::string& text) {
    const std::vector<double> numbers = numbers_of(text);
    Positions points;
    if (numbers.size() % 3 != 0) return points;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

std::optional<Vec3> point_of(const std::string& text) {
    const Positions points = points_of(text);
    return points.size() == 1 ? std::optional(points[0]) : std::nullopt;
}

/// The points with another one added, or taken away if it is one of them.
std::string with_point_switched(Positions points, const Vec3& point) {
    if (std::erase(points, point) == 0) points.push_back(point);
    std::vector<double> numbers;
    for (const Vec3& each : points) numbers.insert(numbers.end(), each.begin(), each.end());
    return numbers.empty() ? "" : to_text(Value(numbers));
}

std::string box_text(const Vec3& a, const Vec3& b) {
    const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
    return to_text(Value(low)) + "," + to_text(Value(high));
}

}  // namespace

std::string picked_text(PickTarget target, const std::string& text, const Vec3& point) {
    const Vec3 now = rounded_place(point);
    if (target == PickTarget::Opening || target == PickTarget::Ends)
        return with_point_switched(points_of(text), now);
    const std::optional<Vec3> before =
        target == PickTarget::Corners ? point_of(text) : std::nullopt;
    return before ? box_text(*before, now) : to_text(Value(now));
}

std::string picked_labels(const std::string& text, int label) {
    std::vector<double> labels = numbers_of(text);
    if (std::erase(labels, label) == 0) labels.push_back(label);
    std::ranges::sort(labels);
    return labels.empty() ? "" : to_text(Value(labels));
}

bool is_complete(PickTarget target, const std::string& text) {
    return target != PickTarget::Labels && (target != PickTarget::Corners || !point_of(text));
}

std::vector<NamedPlace> places_in(const OperationForm& form) {
    std::vector<NamedPlace> places;
    for (const FormField& field : form.fields()) {
        const auto target = pick_target(*field.parameter);
        if (!field.active || !target || target == PickTarget::Labels) continue;
        for (const Vec3& point : points_of(field.text))
            places.push_back({.point = point, .name = readable(field.parameter->name)});
    }
    return places;
}

bool wants_tips(const OperationForm& form) {
    return std::ranges::any_of(form.fields(), [&](const FormField& field) {
        const auto target = pick_target(*field.parameter);
        return target == PickTarget::Tip || target == PickTarget::Ends ||
               target == PickTarget::Opening;
    });
}

}  // namespace vesselbench
