#include "workbench/prepare/recipe.h"

#include <algorithm>
#include <functional>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/near_names.h"
#include "workbench/case/purposes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/builtin_recipes.h"
#include "workbench/review/acceptance.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kKeys = {"operation",     "arguments",   "step",      "optional",
                                        "unless_closed", "unless_made", "otherwise", "when"};

/// The words that "when" may contain.
std::vector<std::string> use_words() {
    std::vector<std::string> words = {"surface", "image", "mask"};
    for (const Purpose& purpose : purposes()) words.push_back(purpose.name);
    return words;
}

void refuse_unknown_keys(const Json& entry) {
    for (const auto& [key, value] : entry.items())
        if (std::ranges::count(kKeys, key) == 0)
            throw UsageError("there is no key '" + shortened(printable(key)) + "'" +
                             did_you_mean(key, kKeys) + " (an entry has " + joined(kKeys) + ")");
}

bool word_holds(const std::string& word, const RecipeUse& use) {
    const bool negated = word.starts_with("no-");
    const std::string name = negated ? word.substr(3) : word;
    const std::vector<std::string> words = use_words();
    if (std::ranges::count(words, name) == 0)
        throw UsageError("\"when\" contains '" + shortened(printable(word)) + "'; it may contain " +
                         joined(words) + ", each also with the prefix no-");
    return (std::ranges::count(use, name) > 0) != negated;
}

bool is_used(const Json& entry, const RecipeUse& use) {
    if (!entry.contains("when")) return true;
    const Json& when = entry["when"];
    if (when.is_string()) return word_holds(when.get<std::string>(), use);
    if (!when.is_array()) refuse_json(when, "when", "a text or a list of texts");
    return std::ranges::all_of(json_value<std::vector<std::string>>(when, "when"),
                               [&](const std::string& word) { return word_holds(word, use); });
}

/// The entry with the purpose's name in place of arguments that are "$purpose".
Json with_purpose(Json entry, const RecipeUse& use) {
    const auto arguments = entry.find("arguments");
    if (arguments == entry.end() || !arguments->is_object()) return entry;
    for (auto& [name, value] : arguments->items()) {
        if (value != "$purpose") continue;
        const auto purpose = std::ranges::find_if(
            purposes(), [&](const Purpose& p) { return std::ranges::count(use, p.name) > 0; });
        if (purpose == purposes().end())
            throw UsageError(name + " is $purpose, but the recipe is for no purpose");
        value = purpose->name;
    }
    return entry;
}

/// The operation and the arguments of an object with these keys.
GivenArguments given_in(JsonFields& fields) {
    const Operation& operation = find_operation(fields.required<std::string>("operation"));
    const Json* given = fields.child("arguments");
    return given ? arguments_from_json(operation, *given) : GivenArguments(operation);
}

/// As given_in() reads them.
Json json_of(const GivenArguments& given) {
    Json json = {{"operation", given.operation().name}};
    if (!given->values().empty()) json["arguments"] = to_json(given);
    return json;
}

RecipeEntry entry_from_json(const Json& json) {
    JsonFields fields(json, "the entry");
    RecipeEntry entry{.given = given_in(fields),
                      .optional = fields.optional<bool>("optional").value_or(false),
                      .unless_closed = fields.optional<bool>("unless_closed").value_or(false)};
    if (const Json* otherwise = fields.child("otherwise"); otherwise && !otherwise->empty())
        entry.otherwise = arguments_from_json(entry.given.operation(), *otherwise);
    if (const Json* made = fields.child("unless_made")) {
        JsonFields edit(*made, fields.place_of("unless_made"));
        entry.unless_made = given_in(edit);
        edit.refuse_unknown_keys();
    }
    if (const auto step = fields.optional<std::string>("step")) entry.step = step_from(*step);
    return entry;
}

/// True for an entry that asks for a review of the others.
bool is_gate(const Json& entry) {
    return entry.contains("require");
}

std::size_t reviewers_of(const Json& gate) {
    JsonFields fields(gate, "the entry");
    const auto text = fields.required<std::string>("require");
    (void)fields.child("when");
    fields.refuse_unknown_keys();
    return required_reviewers(text, "require");
}

/// \throw UsageError that names the entry in which `read` finds a mistake
void read_entries(const Json& list, const std::function<void(const Json&)>& read) {
    if (!list.is_array()) throw UsageError("a recipe is a JSON list of operations");
    for (std::size_t i = 0; i < list.size(); ++i) try {
            if (!list[i].is_object()) throw UsageError("it is not a JSON object");
            read(list[i]);
        } catch (const UsageError& error) {
            throw UsageError("recipe, entry " + std::to_string(i + 1) + ": " + error.what());
        } catch (const InvalidInput& error) {
            throw UsageError("recipe, entry " + std::to_string(i + 1) + ": " + error.what());
        }
}

}  // namespace

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

Recipe recipe_from_json(const Json& list, const RecipeUse& use) {
    Recipe recipe;
    read_entries(list, [&](const Json& json) {
        const bool used = is_used(json, use);
        if (is_gate(json)) return void(reviewers_of(json));
        refuse_unknown_keys(json);
        RecipeEntry entry = entry_from_json(with_purpose(json, use));
        if (used) recipe.push_back(std::move(entry));
    });
    return recipe;
}

std::size_t reviewers_required(const Json& list, const RecipeUse& use) {
    std::size_t reviewers = 0;
    read_entries(list, [&](const Json& json) {
        if (is_gate(json) && is_used(json, use))
            reviewers = std::max(reviewers, reviewers_of(json));
    });
    return reviewers;
}

Json recipe_to_json(const Recipe& recipe) {
    Json list = Json::array();
    for (const RecipeEntry& entry : recipe) {
        Json json = json_of(entry.given);
        if (entry.step) json["step"] = to_string(*entry.step);
        if (entry.optional) json["optional"] = true;
        if (entry.unless_closed) json["unless_closed"] = true;
        if (entry.unless_made) json["unless_made"] = json_of(*entry.unless_made);
        if (entry.otherwise) json["otherwise"] = to_json(*entry.otherwise);
        list.push_back(std::move(json));
    }
    return list;
}

Recipe default_recipe(const RecipeUse& use) {
    return recipe_from_json(json_from_text(builtin_recipe_texts().at("prepare"), "prepare.json"),
                            use);
}

void set_arguments(Recipe& recipe, std::span<const std::string> texts) {
    for (const std::string& text : texts) {
        const std::size_t dot = text.find('.'), equals = text.find('=');
        if (dot == std::string::npos || equals == std::string::npos || dot > equals)
            throw UsageError("--set '" + text + "' is not of the form operation.parameter=value");
        const Operation& operation = find_operation(text.substr(0, dot));
        const std::vector<std::string> argument = {text.substr(dot + 1)};
        const GivenArguments given = arguments_from_texts(operation, argument);
        bool found = false;
        for (RecipeEntry& entry : recipe) {
            if (&entry.given.operation() != &operation) continue;
            found = true;
            entry.given.set(given);
        }
        if (!found) throw UsageError("--set '" + text + "': the recipe has no " + operation.name);
    }
}

}  // namespace vesselbench
