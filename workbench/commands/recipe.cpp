#include <algorithm>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/prepare/kept_recipe.h"
#include "workbench/prepare/recipe_diff.h"
#include "workbench/prepare/recipe_document.h"
#include "workbench/prepare/recipe_schema.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kDiffer = 1, kMistakes = 3;

constexpr const char* kDefaultHelp =
    "What is followed where no recipe is given: entries for each purpose.";

/// The text of the recipe that a project keeps.
/// \throw UsageError unless there is one, and it is clear which
std::string text_in_project(const std::string& project, const std::string& purpose) {
    const std::vector<std::string> kept = kept_purposes(project);
    const std::string name = "'" + bare_name(project) + "'";
    if (kept.empty())
        throw UsageError(name +
                         " keeps no recipe: it was given none. 'log --recipe' writes its "
                         "edits as one");
    if (purpose.empty() && kept.size() > 1)
        throw UsageError(name + " keeps recipes for " + enumerated(kept) + ": give --for");
    const std::string text = kept_recipe_text(project, purpose.empty() ? kept.front() : purpose);
    if (text.empty())
        throw UsageError(name + " keeps no recipe for " + printable(purpose) + ", but for " +
                         enumerated(kept));
    return text;
}

std::string text_of_recipe(const std::string& name, const std::string& purpose) {
    return name.ends_with(".vbench") ? text_in_project(name, purpose) : recipe_text(name);
}

RecipeDocument recipe_of(const std::string& name, const std::string& purpose) {
    return recipe_document(text_of_recipe(name, purpose), bare_name(name));
}

void print(const Json& json) {
    std::cout << text_from_json(json, 2) << "\n";
}

int list_recipes(const RecipeOptions& options) {
    Json all = Json::array();
    std::vector<std::vector<std::string>> rows = {{"recipe", "for", "what it is"}};
    for (const std::string& name : bundled_recipe_names()) {
        const RecipeDocument recipe = bundled_recipe(name);
        all.push_back({{"name", name},
                       {"for", recipe.purposes},
                       {"title", recipe.title},
                       {"description", recipe.description}});
        rows.push_back({name, recipe.purposes.empty() ? "any" : joined(recipe.purposes),
                        name == kDefaultRecipe ? kDefaultHelp : recipe.description});
    }
    if (options.json)
        print({{"recipes", all}});
    else
        std::cout << as_columns(rows);
    return 0;
}

int show_recipe(const RecipeOptions& options) {
    const std::string& name = options.recipes.front();
    if (!options.json) return std::cout << text_of_recipe(name, options.purpose), 0;
    const RecipeDocument recipe = recipe_of(name, options.purpose);
    print({{"name", recipe.name},
           {"title", recipe.title},
           {"description", recipe.description},
           {"for", recipe.purposes},
           {"entries", recipe.entries}});
    return 0;
}

/// Without the line of what is no JSON, which its text names.
Json json_of(const RecipeFault& fault) {
    Json json = {{"place", fault.place}, {"text", fault.text}};
    if (fault.line > 0) json["line"] = fault.line;
    return json;
}

int check_recipe(const RecipeOptions& options) {
    const std::string& name = options.recipes.front();
    RecipeFaults faults;
    const RecipeDocument recipe =
        read_recipe(text_of_recipe(name, options.purpose), bare_name(name), faults);
    Json mistakes = Json::array();
    for (const RecipeFault& fault : faults) mistakes.push_back(json_of(fault));
    const std::string shown = printable(recipe.name);
    if (options.json)
        print({{"recipe", recipe.name}, {"mistakes", mistakes}});
    else if (faults.empty())
        std::cout << shown << ": " << counted(recipe.entries.size(), "entry", "entries")
                  << ", no mistakes\n";
    else
        for (const RecipeFault& fault : faults)
            std::cout << (fault.line > 0 ? shown + ", " : "") << printable(text_of(fault)) << "\n";
    return faults.empty() ? 0 : kMistakes;
}

Json json_of(const RecipeDifference& difference) {
    Json values = Json::array();
    for (const ValueDifference& value : difference.values)
        values.push_back({{"name", value.name}, {"a", value.before}, {"b", value.after}});
    Json json = {{"change", to_string(difference.change)}, {"operation", difference.operation}};
    if (difference.before > 0) json["entry_a"] = difference.before;
    if (difference.after > 0) json["entry_b"] = difference.after;
    json["values"] = values;
    return json;
}

int compare_recipes(const RecipeOptions& options) {
    const RecipeDocument a = recipe_of(options.recipes[0], options.purpose),
                         b = recipe_of(options.recipes[1], options.purpose);
    const auto differences = recipe_differences(a, b);
    Json all = Json::array();
    for (const RecipeDifference& difference : differences) all.push_back(json_of(difference));
    if (options.json)
        print({{"a", a.name}, {"b", b.name}, {"differences", all}});
    else
        for (const RecipeDifference& difference : differences)
            std::cout << printable(text_of(difference)) << "\n";
    return differences.empty() ? 0 : kDiffer;
}

int print_schema(const RecipeOptions&) {
    print(recipe_schema());
    return 0;
}

/// What `recipe` can do, by ACTION.
struct RecipeAction {
    const char* name;
    std::size_t recipes;  ///< that it takes
    int (*run)(const RecipeOptions& options);
};

constexpr RecipeAction kActions[] = {{"list", 0, list_recipes},
                                     {"show", 1, show_recipe},
                                     {"check", 1, check_recipe},
                                     {"diff", 2, compare_recipes},
                                     {"schema", 0, print_schema}};

}  // namespace

std::vector<std::string> recipe_actions() {
    std::vector<std::string> names;
    for (const RecipeAction& action : kActions) names.emplace_back(action.name);
    return names;
}

int use_recipes(const RecipeOptions& options) {
    const RecipeAction& action = *std::ranges::find(
        kActions, options.action, [](const RecipeAction& one) { return std::string(one.name); });
    if (options.recipes.size() != action.recipes)
        throw UsageError("recipe " + options.action + " takes " +
                         (action.recipes == 0 ? "no recipe" : counted(action.recipes, "recipe")) +
                         ", not " + std::to_string(options.recipes.size()));
    return action.run(options);
}

}  // namespace vesselbench
