#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// A text for a parameter of a form; an empty one takes the value away.
struct FieldText {
    std::string parameter;
    std::string text;

    bool operator==(const FieldText&) const = default;
};

/// True if the form's operation has a parameter of this meaning.
[[nodiscard]] bool has_field(const OperationForm& form, Meaning meaning);

/// The name of the parameter of this meaning.
/// \pre has_field
[[nodiscard]] const std::string& name_of(const OperationForm& form, Meaning meaning);

/// The value of a field; none if there is no such field, or it is empty, wrong or without effect.
[[nodiscard]] std::optional<Value> value_of(const OperationForm& form,
                                            const std::string& parameter);

[[nodiscard]] std::optional<double> number_of(const OperationForm& form,
                                              const std::string& parameter);

/// The number that the operation uses: the field's, or the parameter's default.
/// \pre the parameter has a default
[[nodiscard]] double used_number(const OperationForm& form, const std::string& parameter);

[[nodiscard]] std::optional<Vec3> point_of(const OperationForm& form, const std::string& parameter);

/// Empty if it is not given.
[[nodiscard]] std::vector<double> list_of(const OperationForm& form, const std::string& parameter);

[[nodiscard]] Records records_of(const OperationForm& form, const std::string& parameter);

/// The typed text, or an empty one.
[[nodiscard]] std::string text_of(const OperationForm& form, const std::string& parameter);

}  // namespace vesselbench
