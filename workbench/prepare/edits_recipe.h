#pragma once

#include <string>

#include "workbench/session/snapshot.h"

namespace vesselbench {

/// A project's edits as the text of a recipe, which find_recipe() reads: `prepare` makes the same
/// model of the same input with it. Edits that were undone, removed or no longer apply are not in
/// it; the input is what prepare is given. Of an edit that has run on another input than that it
/// was made on, the recipe has the decisions that it kept.
/// \param variant whose edits are meant, with those of the steps that all variants share
/// \param portable for other cases: without edits of places and files of this one, and without the
/// decisions on it; else a comment names these
[[nodiscard]] std::string recipe_of_edits(const Snapshot& now, const std::string& variant,
                                          bool portable);

}  // namespace vesselbench
