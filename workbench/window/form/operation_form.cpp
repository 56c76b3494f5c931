#include "workbench/window/form/operation_form.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/parameter_texts.h"
#include "workbench/case/shell_text.h"

namespace vesselbench {

namespace {

/// Conditions of conditions; more than the table has, so that a circle ends.
constexpr int kDeepestCondition = 4;

/// The value that a field takes: its text, else the operation's decision, else its default; empty:
/// that is not known.
std::string effective_text(const FormField& field) {
    if (!field.text.empty()) return field.text;
    if (field.automatic) return to_text(*field.automatic);
    return field.parameter->default_value ? to_text(*field.parameter->default_value) : "";
}

/// A number may be written with a comma: "0,5".
std::string with_point(const Parameter& parameter, std::string text) {
    if (parameter.type == ParameterType::Real && std::ranges::count(text, ',') == 1)
        std::ranges::replace(text, ',', '.');
    return text;
}

std::string error_in(const FormField& field) {
    if (field.text.empty()) return "";
    try {
        static_cast<void>(checked_value(*field.parameter, Value(field.text)));
    } catch (const UsageError&) {
        return "It must be " + allowed_text(*field.parameter);
    }
    return "";
}

}  // namespace

OperationForm::OperationForm(const Operation& operation, Arguments start)
    : operation_(&operation), given_(std::move(start)) {
    for (const Parameter& parameter : operation.parameters)
        fields_.push_back({.parameter = &parameter});
    fill();
    check();
}

OperationForm::OperationForm(const Operation& operation, const EditRecord& edit)
    : OperationForm(operation, edit.given) {
    edit_ = edit.edit.id;
}

const FormField& OperationForm::field(const std::string& name) const {
    return const_cast<OperationForm*>(this)->find(name);
}

FormField& OperationForm::find(const std::string& name) {
    const Parameter* parameter = &find_parameter(*operation_, name);
    return *std::ranges::find(fields_, parameter, &FormField::parameter);
}

void OperationForm::set(const std::string& name, std::string text) {
    FormField& field = find(name);
    text = with_point(*field.parameter, std::move(text));
    if (field.text == text) return;
    field.text = std::move(text);
    ++changes_;
    check();
}

void OperationForm::fill() {
    for (FormField& field : fields_) {
        const std::string& name = field.parameter->name;
        field.text = given_.has(name) ? to_text(given_.values().at(name)) : "";
    }
}

void OperationForm::reset() {
    fill();
    ++changes_;
    check();
}

bool OperationForm::set_automatic(const Arguments& decided) {
    if (decided == automatic_) return false;
    automatic_ = decided;
    const bool was_valid = valid();
    const Arguments before = was_valid ? arguments() : Arguments();
    for (FormField& field : fields_) {
        const auto value = decided.values().find(field.parameter->name);
        field.automatic.reset();
        if (value != decided.values().end()) field.automatic = value->second;
    }
    check();
    if (was_valid != valid() || (was_valid && before != arguments())) ++changes_;
    return true;
}

bool OperationForm::is_met(const Condition& condition) const {
    const Condition* next = &condition;
    for (int depth = 0; next != nullptr && depth < kDeepestCondition; ++depth) {
        const FormField& cause = field(next->parameter);
        if (!holds(*next, *cause.parameter, effective_text(cause))) return false;
        next = cause.parameter->only_with ? &*cause.parameter->only_with : nullptr;
    }
    return true;
}

void OperationForm::check() {
    error_.clear();
    for (FormField& field : fields_) {
        field.active = !field.parameter->only_with || is_met(*field.parameter->only_with);
        field.error = field.active ? error_in(field) : "";
        if (error_.empty()) error_ = field.error;
    }
    if (!error_.empty()) return;
    try {
        static_cast<void>(checked_arguments(*operation_, arguments()));
    } catch (const UsageError& error) {
        error_ = error.what();
    }
}

Arguments OperationForm::arguments() const {
    Arguments arguments;
    for (const FormField& field : fields_)
        if (field.active && !field.text.empty())
            arguments.set(field.parameter->name,
                          checked_value(*field.parameter, Value(field.text)));
    return arguments;
}

std::string OperationForm::as_command(const std::string& project, const std::string& variant,
                                      std::optional<Step> step) const {
    const Step usual = operation_->usual_step, used = step.value_or(usual);
    std::string command =
        edit_ ? "vesselbench change " + shell_quoted(project) + " " + std::to_string(*edit_)
              : "vesselbench apply " + shell_quoted(project) + " " + operation_->name;
    for (const FormField& field : fields_)
        if (field.active && !field.text.empty())
            command += " " + shell_quoted(field.parameter->name + "=" + field.text);
    if (edit_) return command;
    if (used != usual) command += " --step " + to_string(used);
    if (belongs_to_variant(used)) command += " --variant " + shell_quoted(variant);
    return command;
}

}  // namespace vesselbench
