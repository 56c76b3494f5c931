#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/case/edit_record.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// One parameter of a form, as a text to be edited.
struct FormField {
    const Parameter* parameter = nullptr;
    std::string text;                ///< empty: not given
    std::optional<Value> automatic;  ///< what the operation decides while `text` is empty, if known
    bool active = true;              ///< false: without effect, because of another field's value
    std::string error;               ///< what the text must be; empty: it may be used
};

/// The parameters of an operation as editable texts: what a panel shows, without any drawing. A
/// form makes a new edit, or another revision of one.
class OperationForm {
public:
    /// \param operation of the table: it must outlive the form
    /// \param start what its fields hold at first; the others are empty
    explicit OperationForm(const Operation& operation, Arguments start = {});

    /// A form with the arguments of an earlier edit.
    OperationForm(const Operation& operation, const EditRecord& edit);

    [[nodiscard]] const Operation& operation() const { return *operation_; }

    /// The edit to be changed; none: it makes a new one.
    [[nodiscard]] std::optional<EditId> edit() const { return edit_; }

    [[nodiscard]] const std::vector<FormField>& fields() const { return fields_; }

    /// \throw UsageError if the operation has no such parameter
    [[nodiscard]] const FormField& field(const std::string& name) const;

    /// \throw UsageError as field()
    void set(const std::string& name, std::string text);

    /// Fills every field with what it held at first.
    void reset();

    /// What the operation would decide for parameters that are not given: of those that are known.
    /// \return true if that has changed
    bool set_automatic(const Arguments& decided);

    /// True if apply would accept the arguments.
    [[nodiscard]] bool valid() const { return error_.empty(); }

    /// Why not; empty if it is valid.
    [[nodiscard]] const std::string& error() const { return error_; }

    /// The given arguments, without defaults and without inactive fields. \throw UsageError if a
    /// text is wrong
    [[nodiscard]] Arguments arguments() const;

    /// The command that does the same, quoted for a shell: "vesselbench apply case.vbench smooth
    /// lambda=0.3 --variant cfd".
    /// \param step of a new edit; none: the operation's usual one
    [[nodiscard]] std::string as_command(const std::string& project, const std::string& variant,
                                         std::optional<Step> step = {}) const;

    /// Counts changes of the fields, to notice that a preview is outdated.
    [[nodiscard]] int changes() const { return changes_; }

private:
    void fill();
    void check();
    [[nodiscard]] FormField& find(const std::string& name);
    [[nodiscard]] bool is_met(const Condition& condition) const;

    const Operation* operation_;
    std::optional<EditId> edit_;
    Arguments given_;  ///< at first
    std::vector<FormField> fields_;
    Arguments automatic_;
    std::string error_;
    int changes_ = 0;
};

}  // namespace vesselbench
