#include "workbench/prepare/resumed_recipe.h"

#include <algorithm>

#include "geometry/kernel/wording.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/prepare/resume.h"

namespace vesselbench {

namespace {

/// Entries that are missing in shared steps in the purpose's first own step.
Recipe beside_others(Recipe recipe, const Snapshot& made, const std::string& purpose) {
    const Step own = made.history->first_variant_step();
    const std::vector<EditId> edits = edits_of(recipe, made, purpose);
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        const std::vector<Step>& allowed = recipe[i].given.operation().allowed;
        if (edits[i] == 0 && step_of(recipe[i]) < own && std::ranges::count(allowed, own) > 0)
            recipe[i].step = own;
    }
    return recipe;
}

/// Arguments that are asked for and that an edit did not run with: "preset=cfd, not rp".
std::vector<std::string> differences(const PastEdit& edit, const GivenArguments& asked) {
    std::vector<std::string> texts;
    for (const auto& [name, value] : asked->values()) {
        if (find_parameter(asked.operation(), name).type == ParameterType::File) continue;
        const auto has_value = [&](const Arguments& arguments) {
            return arguments.has(name) && arguments.values().at(name) == value;
        };
        const Arguments& given = edit.edit.given;
        if (has_value(given) || (edit.result && has_value(edit.result->resolved))) continue;
        const Arguments& ran = given.has(name) || !edit.result ? given : edit.result->resolved;
        texts.push_back(ran.has(name) ? name + "=" + to_text(ran.values().at(name)) + ", not " +
                                            to_text(value)
                                      : "without " + name + "=" + to_text(value));
    }
    return texts;
}

/// What an edit's first revision lacks of an entry. Later ones are the user's own changes.
std::vector<std::string> lacking(EditId id, const Snapshot& made, const RecipeEntry& entry) {
    const PastEdit& edit = made.past->at({id, 1});
    const std::vector<std::string> first = differences(edit, entry.given);
    if (!entry.otherwise) return first;
    GivenArguments instead = entry.given;
    instead.set(*entry.otherwise);
    const std::vector<std::string> second = differences(edit, instead);
    return second.size() < first.size() ? second : first;
}

/// How the edits that others share with the purpose differ from its recipe.
std::vector<std::string> shared_remarks(const Recipe& recipe, const Snapshot& made,
                                        const std::string& purpose, const std::string& others) {
    std::vector<std::string> remarks;
    const std::vector<EditId> edits = edits_of(recipe, made, purpose);
    for (const LogEntry& entry : made.log) {
        const EditRecord& edit = entry.edit;
        if (!edit.place.variant.empty()) continue;
        const std::string shared = edit.operation + ": edit " + std::to_string(edit.edit.id) +
                                   " of step " + to_string(edit.place.step) + " is shared with " +
                                   others;
        const auto found = std::ranges::find(edits, edit.edit.id);
        if (found == edits.end()) {
            if (belongs_to_variant(edit.place.step))
                remarks.push_back(shared + ", and not in the recipe");
            continue;
        }
        const auto texts =
            lacking(*found, made, recipe[static_cast<std::size_t>(found - edits.begin())]);
        if (!texts.empty()) remarks.push_back(shared + " and kept: " + joined(texts, "; "));
    }
    return remarks;
}

/// The first entry that only a shared step could hold.
std::string refusal_of(const Recipe& rest, Step own, const std::string& others) {
    const auto shared =
        std::ranges::find_if(rest, [&](const RecipeEntry& entry) { return step_of(entry) < own; });
    if (shared == rest.end()) return "";
    return shared->given.operation().name + " is missing in step " + to_string(step_of(*shared)) +
           ", which is shared with " + others +
           ", and would change that model: prepare this one into another folder";
}

}  // namespace

ResumedRecipe resumed_recipe(const Recipe& recipe, const Snapshot& made, const std::string& purpose,
                             const std::vector<std::string>& done) {
    const std::vector<std::string> others = other_purposes(made, done, purpose);
    ResumedRecipe resumed{.entries =
                              others.empty() ? recipe : beside_others(recipe, made, purpose)};
    resumed.rest = rest_of(resumed.entries, made, purpose);
    resumed.removed = removed_entries(resumed.entries, made, purpose);
    if (others.empty()) return resumed;
    resumed.remarks = shared_remarks(resumed.entries, made, purpose, joined(others));
    resumed.refusal = refusal_of(resumed.rest, made.history->first_variant_step(), joined(others));
    return resumed;
}

std::string all_made_text(const ResumedRecipe& resumed) {
    const std::string all = "every edit of the recipe has been made";
    return resumed.removed.empty()
               ? all
               : all + ", except those removed by hand (" + joined(resumed.removed) + ")";
}

std::vector<Step> repeatable_steps(const ResumedRecipe& resumed, const Snapshot& made,
                                   const std::string& purpose) {
    std::vector<Step> steps;
    for (const LogEntry& entry : made.log) {
        const Step step = entry.edit.place.step;
        if (entry.edit.place.variant != purpose || std::ranges::count(steps, step) > 0) continue;
        if (std::ranges::count(resumed.entries, step, step_of) > 0) steps.push_back(step);
    }
    return steps;
}

std::vector<EditId> own_edits_from(Step first, const Snapshot& made, const std::string& purpose) {
    std::vector<EditId> edits;
    for (const LogEntry& entry : made.log)
        if (entry.edit.place.variant == purpose && entry.edit.place.step >= first)
            edits.push_back(entry.edit.edit.id);
    return edits;
}

Recipe rest_from(Step first, const ResumedRecipe& resumed) {
    Recipe rest = resumed.rest;
    std::erase_if(rest, [&](const RecipeEntry& entry) { return step_of(entry) >= first; });
    for (const RecipeEntry& entry : resumed.entries)
        if (step_of(entry) >= first) rest.push_back(entry);
    return rest;
}

}  // namespace vesselbench
