#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/case/scene.h"
#include "workbench/prepare/apply_recipe.h"
#include "workbench/prepare/input.h"

namespace vesselbench {

/// A case whose vessel ends are about to be opened.
struct BeforeCuts {
    Scene scene;
    Arguments cutting;                     ///< arguments of the edit that would open them
    std::optional<Diagnostic> doubt = {};  ///< about the vessel (vessel_doubt), of a new INPUT
};

/// True for the entry of a recipe that opens vessel ends.
[[nodiscard]] bool cuts_ends(const RecipeEntry& entry);

/// Of a project: the scene before its first edit that cuts ends, or its newest. Of another INPUT:
/// what the recipe of `prepare` makes of it until then, without a file.
/// \param settings "operation.parameter=value", as of `prepare`
/// \throw as prepare()
[[nodiscard]] BeforeCuts before_cuts(const InputOptions& input, const std::string& purpose,
                                     const std::vector<std::string>& settings, const Teller& tell,
                                     const Progress& progress);

}  // namespace vesselbench
