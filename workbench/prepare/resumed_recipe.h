#pragma once

#include <string>
#include <vector>

#include "workbench/prepare/recipe.h"
#include "workbench/session/snapshot.h"

namespace vesselbench {

/// A recipe in a project that has edits.
struct ResumedRecipe {
    Recipe entries;                    ///< all, each with the step in which it is made here
    Recipe rest;                       ///< those that are still to be made
    std::vector<std::string> removed;  ///< operations whose edits were removed by hand, once each
    std::vector<std::string> remarks;  ///< how shared edits differ from the recipe
    std::string refusal;               ///< why the rest cannot be made here; empty: it can
};

/// What is left of a recipe. Where another purpose has a model, too, the steps that they share stay
/// as they are, so that its model does: an entry that is missing there is made in the purpose's own
/// first step, if its operation is allowed in that.
/// \param done the purposes whose model was made, PreparedPurposes::done
[[nodiscard]] ResumedRecipe resumed_recipe(const Recipe& recipe, const Snapshot& made,
                                           const std::string& purpose,
                                           const std::vector<std::string>& done);

/// "every edit of the recipe has been made", with the exception of those that were removed.
[[nodiscard]] std::string all_made_text(const ResumedRecipe& resumed);

/// The steps from which a purpose's model can be made again without touching another one: its own
/// steps in which it has edits, of those that the recipe has entries for; ascending.
[[nodiscard]] std::vector<Step> repeatable_steps(const ResumedRecipe& resumed, const Snapshot& made,
                                                 const std::string& purpose);

/// The purpose's own edits from a step on, which are left out to make them again.
[[nodiscard]] std::vector<EditId> own_edits_from(Step first, const Snapshot& made,
                                                 const std::string& purpose);

/// The entries to be made if the purpose's own edits from a step on are left out.
[[nodiscard]] Recipe rest_from(Step first, const ResumedRecipe& resumed);

}  // namespace vesselbench
