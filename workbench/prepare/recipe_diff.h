#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

/// A value that two recipes give differently, in words: "1.5 (default)", "always".
struct ValueDifference {
    std::string name;  ///< of a parameter, or of a key: "step", "when"
    std::string before, after;
};

enum class RecipeChange { Added, Removed, Moved, Changed };

[[nodiscard]] std::string to_string(RecipeChange change);  ///< "added"

/// How an entry of a recipe differs in another one.
struct RecipeDifference {
    RecipeChange change = RecipeChange::Changed;
    std::string operation;                ///< "require" of a gate; empty: of the whole recipe
    std::size_t before = 0;               ///< number of the entry, from 1 on; 0: it has none
    std::size_t after = 0;                ///< in the other recipe
    std::vector<ValueDifference> values;  ///< also of one that has moved
};

/// What makes the second recipe another one than the first: not titles, comments or the way a value
/// is written, and not a default that is given. Entries of the same operation are compared with
/// each other so that as few values as possible differ.
[[nodiscard]] std::vector<RecipeDifference> recipe_differences(const RecipeDocument& before,
                                                               const RecipeDocument& after);

/// "changed: remesh, entry 14: gradation 1.5 (default) -> 1.3"
[[nodiscard]] std::string text_of(const RecipeDifference& difference);

}  // namespace vesselbench
