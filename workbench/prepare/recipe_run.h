#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "workbench/prepare/recipe.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// Receives messages about a recipe's edits: lines of text, and warnings as values.
class Teller {
public:
    using Lines = std::function<void(const std::string&)>;
    using Warnings = std::function<void(const Diagnostic&)>;

    /// \param warnings empty: they are lines, too, with "warning: " or "note: " before
    /// them
    template <class Tell>

    requires std::constructible_from<Lines, Tell> Teller(
        Tell lines, Warnings warnings = {})  // a function that takes lines is enough
        : lines_(std::move(lines)), warnings_(std::move(warnings)) {}

    void operator()(const std::string& text) const { lines_(text); }

    void warn(const Diagnostic& warning) const;

private:
    Lines lines_;
    Warnings warnings_;
};

/// The loaded surface cannot be repaired, or has no vessel: the input is bad, not the recipe.
class UnusableSource : public DiagnosedInput {
public:
    using DiagnosedInput::DiagnosedInput;
};

/// Something that a recipe could not do as it says.
struct RecipeWarning {
    std::string operation;  ///< of the entry
    Step step = Step::Source;
    std::optional<EditRef> edit;  ///< what was made instead; none: the entry was skipped
    Diagnostic diagnostic;
    std::string variant;  ///< that the entry's edit belongs to; empty: the trunk
};

/// Who watches a recipe's edits; each may be empty. What they throw ends the recipe.
struct RecipeWatch {
    /// An edit of this step is about to run; the progress is for what is done before it.
    std::function<void(Step, const Progress&)> before;
    std::function<void(const LogEntry&)> after;  ///< an edit has run, or no longer applies
    std::function<void(const RecipeWarning&)> warned;
};

/// What a user should know of an edit: its own warnings, and a change of the volume where there
/// should be none.
[[nodiscard]] std::vector<Diagnostic> warnings_of(const LogEntry& entry);

/// True for an entry that is skipped because of an edit that was made (RecipeEntry::unless_made).
[[nodiscard]] bool is_replaced(const RecipeEntry& entry, const std::vector<LogEntry>& log);

/// Applies a recipe's entries to a session, one edit each, in their order. Pending edits before an
/// entry's place run first, and are told of like new ones.
/// \param variant of the edits of steps 4-8
/// \throw what an edit throws; UnusableSource. The session keeps the edits that were done
void run_recipe(Session& session, const Recipe& recipe, const std::string& variant,
                const Teller& tell, const Progress& progress, const RecipeWatch& watch);

/// Runs the pending edits of a variant up to a step, in the same way.
void run_pending(Session& session, const std::string& variant, Step last, const Teller& tell,
                 const Progress& progress, const RecipeWatch& watch);

}  // namespace vesselbench
