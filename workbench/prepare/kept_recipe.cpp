#include "workbench/prepare/kept_recipe.h"

#include <nlohmann/json.hpp>

#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/prepare/case_files.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kStored = "the kept recipes";
constexpr const char* kOne = "the kept recipe";

/// Texts by the purposes' names; of projects of earlier versions, lists of entries.
Json kept_recipes(const fs::path& project) {
    const std::string text = stored_text(project, StoredText::GivenRecipes);
    Json kept = text.empty() ? Json::object() : json_from_text(text, kStored);
    if (!kept.is_object()) refuse_json(kept, kStored, "an object with a list for each purpose");
    return kept;
}

/// A list is the recipe of every purpose.
Json by_purpose(const std::shared_ptr<const Json>& recipes) {
    if (!recipes) return Json::object();
    if (!recipes->is_array()) return *recipes;
    Json each = Json::object();
    for (const Purpose& purpose : purposes()) each[purpose.name] = *recipes;
    return each;
}

/// A text in which the names of files stand for their paths; without its comments if these cannot
/// be kept with certainty.
std::string text_with_file_names(const RecipeDocument& recipe) {
    const Json named = with_file_names(recipe.entries);
    if (named == recipe.entries) return recipe.text;
    return text_from_json(named, 2) + "\n";
}

}  // namespace

void keep_recipe(const fs::path& project, const std::string& purpose,
                 const RecipeDocument& recipe) {
    Json kept = kept_recipes(project);
    kept[purpose] = text_with_file_names(recipe);
    store_text(project, StoredText::GivenRecipes, text_from_json(kept));
}

std::string kept_recipe_text(const fs::path& project, const std::string& purpose) {
    const Json kept = kept_recipes(project);
    const auto found = kept.find(purpose);
    if (found == kept.end()) return "";
    return found->is_string() ? found->get<std::string>() : text_from_json(*found, 2) + "\n";
}

std::vector<std::string> kept_purposes(const fs::path& project) {
    std::vector<std::string> names;
    const Json kept = kept_recipes(project);
    for (const auto& [purpose, recipe] : kept.items()) names.push_back(purpose);
    return names;
}

void take_kept_recipes(Input& input, const fs::path& project) {
    Json kept = kept_recipes(project);
    if (kept.empty()) return;
    for (Json& recipe : kept)
        if (recipe.is_string()) recipe = recipe_document(recipe.get<std::string>(), kOne).entries;
    Json recipes = by_purpose(input.recipes);
    recipes.update(kept);
    input.recipes = std::make_shared<const Json>(std::move(recipes));
    if (input.folder.empty()) input.folder = fs::absolute(project).parent_path();
}

}  // namespace vesselbench
