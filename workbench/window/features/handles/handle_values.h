#pragma once

#include <optional>
#include <string>
#include <variant>

#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// What is typed into a field, else what the operation decides; none: neither is known, or it is of
/// another type.
template <class T>
[[nodiscard]] std::optional<T> shown_value(const OperationForm& form, const std::string& name) {
    std::optional<Value> value = value_of(form, name);
    if (!value) value = form.field(name).automatic;
    if (const T* found = value ? std::get_if<T>(&*value) : nullptr) return *found;
    return std::nullopt;
}

/// The text of a place that is dragged, rounded.
[[nodiscard]] FieldText point_text(const std::string& name, const Vec3& point);

/// The text of a direction that is dragged: of unit length, rounded. \param direction not zero
[[nodiscard]] FieldText direction_text(const std::string& name, const Vec3& direction);

}  // namespace vesselbench
