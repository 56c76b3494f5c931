#include "workbench/prepare/recipe_entry.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"

namespace vesselbench {

Step step_of(const RecipeEntry& entry) {
    return entry.step.value_or(entry.given.operation().usual_step);
}

Step step_from(const std::string& name) {
    std::vector<std::string> names;
    for (int step = 1; step <= static_cast<int>(Step::Review); ++step) {
        names.push_back(to_string(static_cast<Step>(step)));
        if (names.back() == name) return static_cast<Step>(step);
    }
    throw UsageError("there is no step '" + name + "'" + did_you_mean(name, names) +
                     " (the steps are " + joined(names) + ")");
}

}  // namespace vesselbench
