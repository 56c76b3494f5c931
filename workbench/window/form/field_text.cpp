#include "workbench/window/form/field_text.h"

#include <algorithm>

#include "workbench/case/checked_value.h"

namespace vesselbench {

namespace {

const FormField* find(const OperationForm& form, const std::string& parameter) {
    const auto found = std::ranges::find_if(
        form.fields(), [&](const FormField& field) { return field.parameter->name == parameter; });
    return found == form.fields().end() ? nullptr : &*found;
}

double number_in(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return std::get<double>(value);
}

}  // namespace

bool has_field(const OperationForm& form, Meaning meaning) {
    return parameter_of(form.operation(), meaning) != nullptr;
}

const std::string& name_of(const OperationForm& form, Meaning meaning) {
    return parameter_of(form.operation(), meaning)->name;
}

std::optional<Value> value_of(const OperationForm& form, const std::string& parameter) {
    const FormField* field = find(form, parameter);
    if (field == nullptr || !field->active || field->text.empty() || !field->error.empty())
        return std::nullopt;
    return checked_value(*field->parameter, Value(field->text));
}

std::optional<double> number_of(const OperationForm& form, const std::string& parameter) {
    const auto value = value_of(form, parameter);
    return value ? std::optional(number_in(*value)) : std::nullopt;
}

double used_number(const OperationForm& form, const std::string& parameter) {
    const auto given = number_of(form, parameter);
    return given ? *given : number_in(form.field(parameter).parameter->default_value.value());
}

std::optional<Vec3> point_of(const OperationForm& form, const std::string& parameter) {
    const auto value = value_of(form, parameter);
    return value ? std::optional(std::get<Vec3>(*value)) : std::nullopt;
}

std::vector<double> list_of(const OperationForm& form, const std::string& parameter) {
    const auto value = value_of(form, parameter);
    return value ? std::get<std::vector<double>>(*value) : std::vector<double>();
}

Records records_of(const OperationForm& form, const std::string& parameter) {
    const auto value = value_of(form, parameter);
    return value ? std::get<Records>(*value) : Records();
}

std::string text_of(const OperationForm& form, const std::string& parameter) {
    const FormField* field = find(form, parameter);
    return field == nullptr || !field->active || !field->error.empty() ? "" : field->text;
}

}  // namespace vesselbench
