#pragma once

#include <string>
#include <vector>

#include "workbench/prepare/recipe_run.h"

namespace vesselbench {

/// Applies a recipe's entries to a session, one edit each, in their order.
/// \param variant of the edits of steps 4-8
/// \return warnings in addition to those of the edits
/// \throw what an edit throws; UnusableSource. The session keeps the edits that were done
std::vector<Diagnostic> apply_recipe(Session& session, const Recipe& recipe,
                                     const std::string& variant, const Teller& tell,
                                     const Progress& progress);

}  // namespace vesselbench
