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

/// By the purposes' names.
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

}  // namespace

void keep_recipe(const fs::path& project, const std::string& purpose, Json recipe) {
    Json kept = kept_recipes(project);
    kept[purpose] = with_file_names(std::move(recipe));
    store_text(project, StoredText::GivenRecipes, kept.dump());
}

void take_kept_recipes(Input& input, const fs::path& project) {
    const Json kept = kept_recipes(project);
    if (kept.empty()) return;
    Json recipes = by_purpose(input.recipes);
    recipes.update(kept);
    input.recipes = std::make_shared<const Json>(std::move(recipes));
    if (input.folder.empty()) input.folder = fs::absolute(project).parent_path();
}

}  // namespace vesselbench
