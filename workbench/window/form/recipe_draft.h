#pragma once

#include <string>
#include <vector>

#include "workbench/prepare/recipe.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// The entries of a recipe that is about to run, whose arguments can be changed before. Used by the
/// frame's thread.
class RecipeDraft {
public:
    /// Begins again with these entries; what was changed stays as long as they are the same.
    void follow(const Recipe& recipe);

    /// A form for each entry.
    [[nodiscard]] const std::vector<OperationForm>& forms() const { return forms_; }

    /// \pre the entry exists \throw UsageError if its operation has no such parameter
    void set(std::size_t entry, const std::string& parameter, const std::string& text);

    [[nodiscard]] bool is_changed(std::size_t entry) const { return forms_[entry].changes() > 0; }

    [[nodiscard]] bool is_changed() const;

    /// Why it cannot run: the error of the first wrong entry; empty: it can.
    [[nodiscard]] std::string error() const;

    /// The entries with what was changed. \pre error() is empty
    [[nodiscard]] Recipe recipe() const;

    /// Takes back all changes.
    void reset();

private:
    Recipe begun_;
    std::string begun_text_;  ///< by which equal recipes are known
    std::vector<OperationForm> forms_;
};

/// A recipe as `prepare --recipe` reads it.
[[nodiscard]] std::string text_of_recipe(const Recipe& recipe);

}  // namespace vesselbench
