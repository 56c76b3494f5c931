#pragma once

#include "workbench/case/arguments.h"

namespace vesselbench {

struct Operation;

/// Arguments that a user gives to an operation: each is one of its parameters, in the parameter's
/// own type and range. Required ones may be absent, and defaults are not filled in.
class GivenArguments {
public:
    explicit GivenArguments(const Operation& operation) : operation_(&operation) {}

    /// Of the table; must outlive this.
    [[nodiscard]] const Operation& operation() const { return *operation_; }

    /// Takes a value in the parameter's own type; a text is parsed.
    /// \throw UsageError that names the operation, the parameter, the value and what is allowed
    void set(const std::string& name, const Value& value);

    /// Takes all values of `more`, which replace others of the same names.
    /// \param more of the same operation
    void set(const GivenArguments& more);

    // Read access.
    operator const Arguments&() const { return values_; }  // NOLINT: all that can be read

    const Arguments* operator->() const { return &values_; }

private:
    const Operation* operation_;
    Arguments values_;
};

/// All arguments that an operation runs with: those given, and the defaults of the others. Optional
/// ones without a default stay absent. Only checked_arguments() makes them, so that whatever takes
/// them need not check again.
class CheckedArguments {
public:
    /// Arguments that were checked by the process that sent them: for worker processes only.
    [[nodiscard]] static CheckedArguments from_parent_process(Arguments sent) {
        return CheckedArguments(std::move(sent));
    }

    // Read access.
    operator const Arguments&() const { return values_; }  // NOLINT: all that can be read

    const Arguments* operator->() const { return &values_; }

private:
    friend CheckedArguments checked_arguments(const GivenArguments& given);

    explicit CheckedArguments(Arguments values) : values_(std::move(values)) {}

    Arguments values_;
};

/// Checks names, types, ranges and choices. What no parameter has is reported first.
/// \throw UsageError as GivenArguments::set
[[nodiscard]] GivenArguments given_arguments(const Operation& operation, const Arguments& given);

/// Stored arguments with the records that flat lists of their values stand for, as projects of
/// earlier versions have them. Other arguments stay as they are, and so does a list that stands for
/// no records: an edit that runs with it is refused.
[[nodiscard]] Arguments with_records(const Operation& operation, Arguments stored);

/// \throw UsageError that names the operation and the first required parameter that is missing
void check_complete(const GivenArguments& given);

/// Fills in defaults.
/// \throw UsageError as check_complete()
[[nodiscard]] CheckedArguments checked_arguments(const GivenArguments& given);

/// The same, after given_arguments().
/// \throw UsageError as both
[[nodiscard]] CheckedArguments checked_arguments(const Operation& operation,
                                                 const Arguments& given);

}  // namespace vesselbench
