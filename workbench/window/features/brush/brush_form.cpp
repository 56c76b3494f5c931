#include "workbench/window/features/brush/brush_form.h"

#include <algorithm>
#include <cmath>

#include "workbench/case/checked_value.h"
#include "workbench/operations/brush/dabs.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// The operation of a stroke that smooths, whatever the brush.
constexpr const char* kSmoothing = "brush-smooth";

double number_in(const OperationForm& form, const std::string& name, double otherwise) {
    const FormField& field = form.field(name);
    if (field.text.empty() || !field.error.empty()) return otherwise;
    return std::get<double>(checked_value(*field.parameter, Value(field.text)));
}

bool can_invert(const Operation& operation) {
    return find_parameter(operation, "strength").minimum < 0.0;
}

Arguments lasting(const OperationForm& form) {
    const Arguments all = form.arguments();
    Arguments given;
    for (const auto& [name, value] : all.values())
        if (!is_dab_argument(name)) given.set(name, value);
    return given;
}

}  // namespace

BrushTip tip_of(const OperationForm& form, const BrushTip& otherwise) {
    return {number_in(form, "radius", otherwise.radius),
            number_in(form, "strength", otherwise.strength)};
}

void set_tip(OperationForm& form, const BrushTip& tip) {
    form.set("radius", to_text(Value(tip.radius)));
    form.set("strength", to_text(Value(tip.strength)));
}

StrokeRequest stroke_of(const OperationForm& form, const BrushTip& tip, StrokeKeys keys) {
    const bool other = keys.smooth && form.operation().name != kSmoothing;
    const Operation& operation = other ? find_operation(kSmoothing) : form.operation();
    StrokeRequest request{.operation = operation.name,
                          .radius = tip.radius,
                          .strength = tip.strength,
                          .falloff = number_in(form, "falloff", 1.0)};
    if (!other) request.given = lasting(form);
    if (!can_invert(operation))
        request.strength = std::abs(tip.strength);
    else if (keys.invert)
        request.strength = -tip.strength;
    return request;
}

std::string painted_attribute(const OperationForm& form) {
    const auto field = std::ranges::find(
        form.fields(), "attribute", [](const FormField& each) { return each.parameter->name; });
    if (field == form.fields().end()) return "";
    return field->text.empty() ? to_text(*field->parameter->default_value) : field->text;
}

}  // namespace vesselbench
