#include "workbench/prepare/recipe.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/entry_reader.h"
#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// As an entry has it.
Json json_of(const GivenArguments& given) {
    Json json = {{"operation", given.operation().name}};
    if (!given->values().empty()) json["arguments"] = to_json(given);
    return json;
}

/// \throw UsageError that names the first entry with a fault
template <class Take>
void read_entries(const Json& list, const RecipeUse& use, Take take) {
    if (!list.is_array()) throw UsageError("a recipe is a JSON list of operations");
    for (std::size_t i = 0; i < list.size(); ++i) {
        RecipeFaults faults;
        ReadEntry read = read_entry(list[i], use, "", faults);
        if (!faults.empty())
            throw UsageError("recipe, entry " + std::to_string(i + 1) + ": " + faults[0].text);
        if (read.used) take(std::move(read));
    }
}

/// What is prepared is what is given as the input: its name and its bytes stand for the results.
void refuse_input_file(const Operation& operation, const std::string& parameter) {
    const bool is_file = std::ranges::any_of(operation.parameters, [&](const Parameter& p) {
        return p.name == parameter && p.type == ParameterType::File;
    });
    if (operation.recipe.loads && operation.recipe.loads != InputKind::Neighbour && is_file)
        throw UsageError("--set " + operation.name + "." + parameter +
                         ": the input itself is given, not set");
}

/// True if one of the arguments is among those that the entry would replace.
bool replaces(const RecipeEntry& entry, const GivenArguments& given) {
    return entry.otherwise && std::ranges::any_of(given->values(), [&](const auto& argument) {
               return (*entry.otherwise)->has(argument.first);
           });
}

}  // namespace

Recipe recipe_from_json(const Json& list, const RecipeUse& use) {
    Recipe recipe;
    read_entries(list, use, [&](ReadEntry read) {
        if (read.entry) recipe.push_back(std::move(*read.entry));
    });
    return recipe;
}

std::size_t reviewers_required(const Json& list, const RecipeUse& use) {
    std::size_t reviewers = 0;
    read_entries(list, use,
                 [&](const ReadEntry& read) { reviewers = std::max(reviewers, read.reviewers); });
    return reviewers;
}

Json recipe_to_json(const Recipe& recipe) {
    Json list = Json::array();
    for (const RecipeEntry& entry : recipe) {
        Json json = json_of(entry.given);
        if (entry.step) json["step"] = to_string(*entry.step);
        if (entry.optional) json["optional"] = true;
        if (entry.unless_closed) json["unless_closed"] = true;
        for (const GivenArguments& made : entry.unless_made)
            json["unless_made"].push_back(json_of(made));
        if (entry.otherwise) json["otherwise"] = to_json(*entry.otherwise);
        list.push_back(std::move(json));
    }
    return list;
}

Recipe default_recipe(const RecipeUse& use) {
    return recipe_from_json(bundled_recipe(kDefaultRecipe).entries, use);
}

void set_arguments(Recipe& recipe, std::span<const std::string> texts) {
    for (const std::string& text : texts) {
        const std::size_t dot = text.find('.'), equals = text.find('=');
        if (dot == std::string::npos || equals == std::string::npos || dot > equals)
            throw UsageError("--set '" + text + "' is not of the form operation.parameter=value");
        const Operation& operation = find_operation(text.substr(0, dot));
        refuse_input_file(operation, text.substr(dot + 1, equals - dot - 1));
        const std::vector<std::string> argument = {text.substr(dot + 1)};
        const GivenArguments given = arguments_from_texts(operation, argument);
        bool found = false;
        for (RecipeEntry& entry : recipe) {
            if (&entry.given.operation() != &operation) continue;
            found = true;
            entry.given.set(given);
            // What is asked for by name is made, or refused.
            if (replaces(entry, given)) entry.otherwise.reset();
        }
        if (!found) throw UsageError("--set '" + text + "': the recipe has no " + operation.name);
    }
}

}  // namespace vesselbench
