#include "workbench/prepare/apply_recipe.h"

namespace vesselbench {

std::vector<Diagnostic> apply_recipe(Session& session, const Recipe& recipe,
                                     const std::string& variant, const Teller& tell,
                                     const Progress& progress) {
    std::vector<Diagnostic> warnings;
    run_recipe(
        session, recipe, variant, tell, progress,
        {.warned = [&](const RecipeWarning& warning) { warnings.push_back(warning.diagnostic); }});
    return warnings;
}

}  // namespace vesselbench
