#include "workbench/window/features/handles/stretch_handles.h"

#include <algorithm>
#include <optional>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/window/features/handles/handle_values.h"

namespace vesselbench {

namespace {

constexpr double kLeastShare = 0.1;  ///< of the stretch, and of the radius, that a drag leaves [-]

struct Stretch {
    Vec3 from, to;
    double radius = 0.0;

    [[nodiscard]] Vec3 along() const { return (to - from).normalized(); }

    [[nodiscard]] Vec3 middle() const { return 0.5 * (from + to); }

    /// Where the radius has its handle.
    [[nodiscard]] Vec3 across() const {
        Eigen::Index smallest = 0;
        along().cwiseAbs().minCoeff(&smallest);
        return along().cross(Vec3::Unit(smallest)).normalized();
    }
};

std::optional<Stretch> stretch_of(const OperationForm& form) {
    const auto from = shown_value<Vec3>(form, "from"), to = shown_value<Vec3>(form, "to");
    const auto radius = shown_value<double>(form, "radius");
    if (!from || !to || !radius || !((*to - *from).norm() > 0.0)) return std::nullopt;
    return Stretch{*from, *to, *radius};
}

Handle end_handle(const std::string& name, const Vec3& point, const Vec3& along) {
    return {.name = name,
            .point = point,
            .path = HandlePath::Line,
            .direction = along,
            .help = "Move this end of the stretch along the vessel"};
}

}  // namespace

bool has_stretch(const OperationForm& form) {
    const auto has_point = [&](const char* name) {
        return std::ranges::any_of(form.fields(), [&](const FormField& field) {
            return field.parameter->name == name && field.parameter->type == ParameterType::Point;
        });
    };
    return has_point("from") && has_point("to");
}

FormShape stretch_shape(const OperationForm& form) {
    FormShape shape;
    const auto stretch = stretch_of(form);
    if (!stretch) return shape;
    const bool faint = !value_of(form, "from") || !value_of(form, "to");
    for (const Vec3& centre : {stretch->from, stretch->middle(), stretch->to}) {
        shape.lines.push_back(circle_line(centre, stretch->along(), stretch->radius));
        shape.lines.back().faint = faint;
    }
    shape.lines.push_back({.points = {stretch->from, stretch->to}, .faint = faint});
    const Vec3 rim = stretch->middle() + stretch->radius * stretch->across();
    shape.handles = {end_handle("stretch.from", stretch->from, stretch->along()),
                     end_handle("stretch.to", stretch->to, stretch->along()),
                     {.name = "stretch.radius",
                      .point = rim,
                      .path = HandlePath::Line,
                      .direction = stretch->across(),
                      .look = HandleLook::Ring,
                      .help = "Change the radius"}};
    shape.notes.push_back({rim, "radius " + formatted(stretch->radius, "%.3g mm")});
    return shape;
}

std::vector<FieldText> stretch_texts(const OperationForm& form, std::size_t handle,
                                     const Vec3& to) {
    const auto before = stretch_of(form);
    if (!before) return {};
    const auto text = [](const Vec3& p) { return to_text(Value(rounded_place(p))); };
    const double length = (before->to - before->from).norm();
    if (handle == 2) {
        const double radius =
            std::max(before->across().dot(to - before->middle()), kLeastShare * before->radius);
        return {{"radius", to_text(Value(rounded_length(radius)))}};
    }
    // The ends do not pass each other.
    const double along = before->along().dot(to - before->from);
    if (handle == 0) {
        const double at = std::min(along, (1.0 - kLeastShare) * length);
        return {{"from", text(before->from + at * before->along())}, {"to", text(before->to)}};
    }
    const double at = std::max(along, kLeastShare * length);
    return {{"from", text(before->from)}, {"to", text(before->from + at * before->along())}};
}

}  // namespace vesselbench
