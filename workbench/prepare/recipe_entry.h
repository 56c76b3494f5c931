#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

/// One edit of a recipe.
struct RecipeEntry {
    GivenArguments given;                     ///< also names the operation
    std::optional<Step> step = std::nullopt;  ///< none: the operation's usual step
    bool optional = false;  ///< if it cannot be done, a warning is given and the recipe continues
    bool unless_closed = false;  ///< skipped if the surface has no border at that point
    /// Skipped if such an edit was made, with these values among its resolved arguments.
    std::optional<GivenArguments> unless_made = std::nullopt;
    /// Replace some of the given ones if they cannot be done.
    std::optional<GivenArguments> otherwise = std::nullopt;
};

using Recipe = std::vector<RecipeEntry>;

/// The step of the edit that an entry becomes.
[[nodiscard]] Step step_of(const RecipeEntry& entry);

/// The use of a recipe: words that an entry's "when" may contain.
using RecipeUse = std::vector<std::string>;  ///< of "surface" or "image", "mask", and the purpose

/// \throw UsageError that lists the steps if there is none of this name
[[nodiscard]] Step step_from(const std::string& name);

}  // namespace vesselbench
