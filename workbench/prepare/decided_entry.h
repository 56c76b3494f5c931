#pragma once

#include <string>

#include "workbench/prepare/recipe_entry.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// An entry as it runs in a project, and what is to be said of that.
struct DecidedEntry {
    RecipeEntry entry;
    std::string remark;  ///< "1 end as decided in the variant cfd: closed at ..."; empty: nothing
};

/// Completes an entry that opens vessel ends by the decisions of the project's edits
/// (decided_ends): where the odds alone would decide otherwise about an end, or doubt, the end is
/// named in `inlet`, `open` or `closed`. An end that the entry itself names, and one whose vessel
/// changed, is not. A print that leaves closed ends as they are opens none of them. What the entry
/// names by numbers, it names by places then. \param variant of the entry's edit
[[nodiscard]] DecidedEntry decided_entry(const RecipeEntry& entry, Session& session,
                                         const std::string& variant, const Progress& progress);

/// The arguments of a changed edit: those it has, and `more`, which replace others of the same
/// names. Of an edit that opens all vessel ends, what `more` says of ends and inlets is all that
/// changes about them: each other end stays what the edit made of it, as decided_entry() has it.
/// Planes that were given are chosen again then.
/// \throw UsageError if the current state has no such edit, or `more` is of another operation
[[nodiscard]] DecidedEntry decided_change(EditId edit, const GivenArguments& more, Session& session,
                                          const Progress& progress);

}  // namespace vesselbench
