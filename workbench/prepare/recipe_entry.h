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
    /// Skipped if one of such edits was made, with these values among its resolved arguments.
    std::vector<GivenArguments> unless_made = {};
    /// Replace some of the given ones if they cannot be done.
    std::optional<GivenArguments> otherwise = std::nullopt;
    /// Its method is that of a drawn mask, and not of one that a value bounds: extraction_entry.h.
    bool if_drawn = false;
};

using Recipe = std::vector<RecipeEntry>;

/// The step of the edit that an entry becomes.
[[nodiscard]] Step step_of(const RecipeEntry& entry);

/// The use of a recipe: words that an entry's "when" may contain.
using RecipeUse = std::vector<std::string>;  ///< of "surface" or "image", "mask", and the purpose

/// Further words of a use, which say what "$mask" is: the mask is the vessel's wall, because it was
/// asked for, or if it is drawn.
inline constexpr const char *kWallMask = "wall-mask", *kDrawnMask = "drawn-mask";

/// \throw UsageError that lists the steps if there is none of this name
[[nodiscard]] Step step_from(const std::string& name);

}  // namespace vesselbench
