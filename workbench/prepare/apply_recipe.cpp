#include "workbench/prepare/apply_recipe.h"

namespace vesselbench {

std::vector<std::string> apply_recipe(Session& session, const Recipe& recipe,
                                      const std::string& variant, const Teller& tell,
                                      const Progress& progress) {
    std::vector<std::string> warnings;
    run_recipe(session, recipe, variant, tell, progress,
               {.warned = [&](const RecipeWarning& warning) { warnings.push_back(warning.text); }});
    return warnings;
}

}  // namespace vesselbench
