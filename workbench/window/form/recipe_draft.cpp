#include "workbench/window/form/recipe_draft.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "workbench/case/json_text.h"

namespace vesselbench {

void RecipeDraft::follow(const Recipe& recipe) {
    std::string text = text_from_json(recipe_to_json(recipe));
    if (text == begun_text_ && recipe.size() == begun_.size()) return;
    begun_ = recipe;
    begun_text_ = std::move(text);
    reset();
}

void RecipeDraft::reset() {
    forms_.clear();
    for (const RecipeEntry& entry : begun_)
        forms_.emplace_back(entry.given.operation(), Arguments(entry.given));
}

void RecipeDraft::set(std::size_t entry, const std::string& parameter, const std::string& text) {
    forms_.at(entry).set(parameter, text);
}

bool RecipeDraft::is_changed() const {
    return std::ranges::any_of(forms_,
                               [](const OperationForm& form) { return form.changes() > 0; });
}

std::string RecipeDraft::error() const {
    for (std::size_t i = 0; i < forms_.size(); ++i)
        if (is_changed(i) && !forms_[i].valid()) return forms_[i].error();
    return "";
}

Recipe RecipeDraft::recipe() const {
    Recipe recipe = begun_;
    for (std::size_t i = 0; i < recipe.size(); ++i)
        if (is_changed(i))
            recipe[i].given = given_arguments(forms_[i].operation(), forms_[i].arguments());
    return recipe;
}

std::string text_of_recipe(const Recipe& recipe) {
    return text_from_json(recipe_to_json(recipe), 2) + "\n";
}

}  // namespace vesselbench
