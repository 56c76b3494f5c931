#include "workbench/prepare/before_cuts.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/decided_entry.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/prepare/vessel_question.h"
#include "workbench/session/session.h"

namespace vesselbench {

namespace {

/// The operation that opens vessel ends.
const Operation& cutting_operation() {
    return *std::ranges::find_if(
        operation_table(), [](const Operation& operation) { return operation.recipe.cuts_ends; });
}

BeforeCuts of_project(const std::string& project, const Progress& progress) {
    Session session = Session::open(project, {.find = find_operation});
    const std::string variant = variant_of(project, "", *session.snapshot()->history);
    BeforeCuts before;
    EditId last = 0;
    bool cut = false;
    for (const LogEntry& entry : session.log(variant)) {
        cut = find_operation(entry.edit.operation).recipe.cuts_ends;
        if (cut) {
            before.cutting = entry.edit.given;
            break;
        }
        if (entry.edit.place.step > Step::Openings) break;
        last = entry.edit.edit.id;
    }
    if (last == 0) throw UsageError("the project has no surface before its openings");
    if (!cut) {  // as a recipe would open them, by what other variants decided
        const RecipeEntry entry{.given = GivenArguments(cutting_operation())};
        before.cutting = decided_entry(entry, session, variant, progress.silent()).entry.given;
    }
    before.cutting = checked_arguments(cutting_operation(), before.cutting);
    before.scene = session.scene_after(last, progress);
    return before;
}

}  // namespace

bool cuts_ends(const RecipeEntry& entry) {
    return entry.given.operation().recipe.cuts_ends;
}

BeforeCuts before_cuts(const InputOptions& options, const std::string& purpose,
                       const std::vector<std::string>& settings, const Teller& tell,
                       const Progress& progress) {
    if (options.input.ends_with(".vbench")) return of_project(options.input, progress);
    Input input = resolve_input(options, progress.part(0.0, 0.02));
    take_settings_of_mask(input, settings);
    Recipe recipe = input_recipe(input, purpose, own_recipe(input, purpose));
    set_arguments(recipe, settings);
    const auto cut = std::ranges::find_if(recipe, cuts_ends);
    BeforeCuts before;
    if (cut == recipe.end()) throw UsageError("the recipe opens no vessel ends");
    const GivenArguments cutting = cut->given;
    before.cutting = checked_arguments(cutting);
    recipe.erase(cut, recipe.end());
    Session session = Session::unsaved({.find = find_operation});
    apply_recipe(session, recipe, purpose, tell, progress.part(0.02, 1.0));
    before.scene = session.scene(purpose);
    before.doubt = vessel_doubt(cutting, session);
    return before;
}

}  // namespace vesselbench
