#include "workbench/prepare/recipe_diff.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/parameter_texts.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;
using Values = std::map<std::string, std::string>;

/// An entry in words.
struct WordedEntry {
    std::string operation;
    Values values;  ///< of its parameters and keys; of parameters that are not given, the defaults
};

std::string value_text(const Operation& operation, const std::string& name, const Json& value) {
    for (const char* decided_later : {"$purpose", "$mask"})
        if (value == decided_later) return decided_later;
    const GivenArguments given = arguments_from_json(operation, Json{{name, value}});
    return to_text(given->values().at(name));
}

/// A default that is given is the same as one that is not.
std::string with_default(const Parameter& parameter, const std::string& text) {
    const std::string usual = default_text(parameter);
    return text == usual && parameter.default_value ? text + " (default)" : text;
}

void add_arguments(Values& values, const Operation& operation, const Json& given) {
    for (const Parameter& parameter : operation.parameters) {
        const bool is_given = given.contains(parameter.name);
        values[parameter.name] = with_default(
            parameter, is_given ? value_text(operation, parameter.name, given[parameter.name])
                                : default_text(parameter));
    }
}

std::string when_text(const Json& entry) {
    if (!entry.contains("when")) return "always";
    if (entry["when"].is_string()) return entry["when"].get<std::string>();
    return joined(entry["when"].get<std::vector<std::string>>(), " and ");
}

std::string flag_text(const Json& entry, const char* key) {
    return entry.value(key, false) ? "true" : "false";
}

/// \pre the entry was checked
WordedEntry worded_entry(const Json& entry) {
    if (entry.contains("require"))
        return {"require",
                {{"reviewers", entry["require"].get<std::string>()}, {"when", when_text(entry)}}};
    const Operation& operation = find_operation(entry["operation"].get<std::string>());
    WordedEntry worded{operation.name,
                       {{"step", entry.value("step", to_string(operation.usual_step))},
                        {"when", when_text(entry)},
                        {"optional", flag_text(entry, "optional")},
                        {"unless_closed", flag_text(entry, "unless_closed")},
                        {"unless_made", entry.value("unless_made", Json("none")).dump()}}};
    add_arguments(worded.values, operation, entry.value("arguments", Json::object()));
    const Json otherwise = entry.value("otherwise", Json::object());
    for (const auto& [name, value] : otherwise.items())
        worded.values["otherwise " + name] = value_text(operation, name, value);
    return worded;
}

std::vector<WordedEntry> worded_entries(const RecipeDocument& recipe) {
    std::vector<WordedEntry> entries;
    for (const Json& entry : recipe.entries) entries.push_back(worded_entry(entry));
    return entries;
}

std::vector<ValueDifference> value_differences(const Values& before, const Values& after) {
    const auto in = [](const Values& values, const std::string& name) {
        const auto found = values.find(name);
        return found == values.end() ? std::string("none") : found->second;
    };
    std::vector<ValueDifference> differences;
    Values all = before;
    all.insert(after.begin(), after.end());
    for (const auto& [name, ignored] : all)
        if (in(before, name) != in(after, name))
            differences.push_back({name, in(before, name), in(after, name)});
    return differences;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// What pairing two entries is worth: more, the fewer values differ; 0: other operations.
std::size_t worth(const WordedEntry& a, const WordedEntry& b) {
    if (a.operation != b.operation) return 0;
    constexpr std::size_t kOperation = 1000;
    return kOperation - std::min(kOperation - 1, value_differences(a.values, b.values).size());
}

/// Pairs of entries in the order of both recipes, with the largest worth (longest common
/// subsequence, weighted).
Pairs pairs_in_order(const std::vector<WordedEntry>& a, const std::vector<WordedEntry>& b) {
    std::vector<std::vector<std::size_t>> best(a.size() + 1,
                                               std::vector<std::size_t>(b.size() + 1, 0));
    for (std::size_t i = a.size(); i-- > 0;)
        for (std::size_t j = b.size(); j-- > 0;) {
            const std::size_t pair = worth(a[i], b[j]);
            best[i][j] = std::max(
                {best[i + 1][j], best[i][j + 1], pair == 0 ? 0 : pair + best[i + 1][j + 1]});
        }
    Pairs pairs;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const std::size_t pair = worth(a[i], b[j]);
        if (pair > 0 && best[i][j] == pair + best[i + 1][j + 1])
            pairs.emplace_back(i++, j++);
        else if (best[i][j] == best[i + 1][j])
            ++i;
        else
            ++j;
    }
    return pairs;
}

/// Entries of the same operation that are left: they have moved.
Pairs moved_pairs(const std::vector<WordedEntry>& a, const std::vector<WordedEntry>& b,
                  const Pairs& in_order) {
    Pairs moved;
    const auto is_paired = [&](auto part, std::size_t i) {
        return std::ranges::count(in_order, i, part) + std::ranges::count(moved, i, part) > 0;
    };
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (is_paired(&Pairs::value_type::first, i)) continue;
        std::size_t best = b.size();
        for (std::size_t j = 0; j < b.size(); ++j)
            if (!is_paired(&Pairs::value_type::second, j) && worth(a[i], b[j]) > 0 &&
                (best == b.size() || worth(a[i], b[j]) > worth(a[i], b[best])))
                best = j;
        if (best < b.size()) moved.emplace_back(i, best);
    }
    return moved;
}

std::string purposes_text(const RecipeDocument& recipe) {
    return recipe.purposes.empty() ? "any purpose" : joined(recipe.purposes);
}

}  // namespace

std::string to_string(RecipeChange change) {
    switch (change) {
        case RecipeChange::Added:
            return "added";
        case RecipeChange::Removed:
            return "removed";
        case RecipeChange::Moved:
            return "moved";
        case RecipeChange::Changed:
            return "changed";
    }
    return "";
}

std::vector<RecipeDifference> recipe_differences(const RecipeDocument& before,
                                                 const RecipeDocument& after) {
    std::vector<RecipeDifference> differences;
    if (purposes_text(before) != purposes_text(after))
        differences.push_back({.values = {{"for", purposes_text(before), purposes_text(after)}}});
    const auto a = worded_entries(before), b = worded_entries(after);
    std::vector<bool> kept(a.size(), false), known(b.size(), false);
    const auto compare = [&](const Pairs& pairs, RecipeChange change) {
        for (const auto& [i, j] : pairs) {
            kept[i] = known[j] = true;
            auto values = value_differences(a[i].values, b[j].values);
            if (change == RecipeChange::Moved || !values.empty())
                differences.push_back({change, a[i].operation, i + 1, j + 1, std::move(values)});
        }
    };
    const Pairs in_order = pairs_in_order(a, b);
    compare(in_order, RecipeChange::Changed);
    compare(moved_pairs(a, b, in_order), RecipeChange::Moved);
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!kept[i]) differences.push_back({RecipeChange::Removed, a[i].operation, i + 1, 0, {}});
    for (std::size_t j = 0; j < b.size(); ++j)
        if (!known[j]) differences.push_back({RecipeChange::Added, b[j].operation, 0, j + 1, {}});
    return differences;
}

std::string text_of(const RecipeDifference& difference) {
    std::string text = to_string(difference.change) + ": " +
                       (difference.operation.empty() ? "the recipe" : difference.operation);
    const std::size_t either = std::max(difference.before, difference.after);
    if (either > 0)
        text += ", entry " + std::to_string(difference.before > 0 ? difference.before : either);
    if (difference.before > 0 && difference.after > 0 && difference.before != difference.after)
        text += " -> " + std::to_string(difference.after);
    std::vector<std::string> values;
    for (const ValueDifference& value : difference.values)
        values.push_back(value.name + " " + value.before + " -> " + value.after);
    return values.empty() ? text : text + ": " + joined(values, "; ");
}

}  // namespace vesselbench
