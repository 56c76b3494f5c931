#include "workbench/prepare/recipe_document.h"

#include <algorithm>
#include <filesystem>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/regular_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_lines.h"
#include "workbench/case/json_text.h"
#include "workbench/case/near_names.h"
#include "workbench/case/purposes.h"
#include "workbench/prepare/builtin_recipes.h"
#include "workbench/prepare/entry_reader.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::vector<std::string> kKeys = {"$schema", "title",  "description", "for",
                                        "on",      "change", "entries"};

/// The step of an entry, if it is one of an edit that can be read.
std::optional<Step> step_in(const Json& entry) {
    Json edit = Json::object();
    for (const char* key : {"operation", "step"})
        if (entry.contains(key)) edit[key] = entry[key];
    RecipeFaults ignored;
    const auto read = read_change(edit, "", ignored);
    return read ? std::optional(step_of(*read)) : std::nullopt;
}

/// Reads what is around the entries.
class DocumentReader {
public:
    DocumentReader(const Json& json, RecipeDocument& document, RecipeFaults& faults)
        : json_(json), document_(document), faults_(faults) {}

    void read() {
        if (json_.is_array()) {
            document_.entries = json_;
            return check_entries(json_, "");
        }
        if (!json_.is_object() || json_.contains("operation"))
            return fault("",
                         "a recipe is a JSON list of operations, or an object with such a list "
                         "as its \"entries\"");
        refuse_other_keys();
        read_texts();
        read_purposes();
        read_base();
        read_changes();
        read_entries();
    }

private:
    void fault(const std::string& place, const std::string& text) {
        faults_.push_back({.place = place, .text = text});
    }

    void refuse_other_keys() {
        for (const auto& [key, value] : json_.items())
            if (std::ranges::count(kKeys, key) == 0)
                fault("/" + key, "there is no key '" + shortened(printable(key)) + "'" +
                                     did_you_mean(key, kKeys) + " (a recipe has " + joined(kKeys) +
                                     ")");
    }

    template <class Read>
    void with(const std::string& key, Read read) {
        const auto found = json_.find(key);
        if (found != json_.end()) note_faults(faults_, "/" + key, [&] { read(*found); });
    }

    void read_texts() {
        std::string schema;
        for (const auto& [key, text] : {std::pair{"$schema", &schema},
                                        {"title", &document_.title},
                                        {"description", &document_.description}})
            with(key, [&](const Json& json) { *text = json_value<std::string>(json, key); });
    }

    void read_purposes() {
        with("for", [&](const Json& json) {
            document_.purposes = json.is_string()
                                     ? std::vector{json.get<std::string>()}
                                     : json_value<std::vector<std::string>>(json, "for");
            const std::vector<std::string> known = purpose_names();
            for (const std::string& name : document_.purposes)
                if (std::ranges::count(known, name) == 0)
                    throw UsageError("there is no purpose '" + shortened(printable(name)) + "'" +
                                     did_you_mean(name, known) + " (it is " + joined(known) + ")");
        });
    }

    void read_base() {
        with("on", [&](const Json& json) {
            document_.entries = bundled_recipe(json_value<std::string>(json, "on")).entries;
        });
        if (!json_.contains("on") && !json_.contains("entries"))
            fault("", "it has neither \"entries\" nor \"on\"");
    }

    void read_changes() {
        with("change", [&](const Json& json) {
            if (!json_.contains("on"))
                throw UsageError("\"change\" is of a bundled recipe, which \"on\" names");
            if (!json.is_array()) refuse_json(json, "change", "a list of objects");
            for (std::size_t i = 0; i < json.size(); ++i)
                change(json[i], "/change/" + std::to_string(i));
        });
    }

    void change(const Json& json, const std::string& place) {
        const auto change = read_change(json, place, faults_);
        if (!change) return;
        const std::string& name = change->given.operation().name;
        bool found = false;
        for (Json& entry : document_.entries) {
            if (entry.value("operation", "") != name) continue;
            if (change->step && step_in(entry) != change->step) continue;
            found = true;
            entry["arguments"].update(to_json(change->given));
        }
        if (!found)
            fault(place, "the recipe " + json_["on"].dump() + " has no " + name +
                             (change->step ? " in the step " + to_string(*change->step) : ""));
    }

    void read_entries() {
        with("entries", [&](const Json& json) {
            if (!json.is_array()) refuse_json(json, "entries", "a list of operations");
            check_entries(json, "/entries");
            for (const Json& entry : json) insert(entry);
        });
    }

    /// Behind those of its step, or last.
    void insert(const Json& entry) {
        const auto step = entry.is_object() ? step_in(entry) : std::nullopt;
        auto at = document_.entries.end();
        if (json_.contains("on") && step)
            at = std::ranges::find_if(document_.entries,
                                      [&](const Json& other) { return step_in(other) > step; });
        document_.entries.insert(at, entry);
    }

    /// An entry is read for every purpose: "$purpose" has another meaning for each.
    void check_entries(const Json& list, const std::string& place) {
        std::vector<std::string> names = document_.purposes;
        if (names.empty()) names = purpose_names();
        for (std::size_t i = 0; i < list.size(); ++i) {
            RecipeFaults found;
            for (const std::string& purpose : names)
                (void)read_entry(list[i], {"surface", purpose}, place + "/" + std::to_string(i),
                                 found);
            for (const RecipeFault& one : found)
                if (std::ranges::none_of(faults_, [&](const RecipeFault& known) {
                        return known.place == one.place && known.text == one.text;
                    }))
                    faults_.push_back(one);
        }
    }

    const Json& json_;
    RecipeDocument& document_;
    RecipeFaults& faults_;
};

/// "entry 3, ", "change 1, "; empty: of the whole.
std::string part_of(const std::string& place) {
    const bool is_change = place.starts_with("/change/");
    const std::string rest =
        place.substr(is_change                        ? 8
                     : place.starts_with("/entries/") ? 9
                                                      : std::min<std::size_t>(1, place.size()));
    const std::string index = rest.substr(0, rest.find('/'));
    if (index.empty() || index.find_first_not_of("0123456789") != std::string::npos) return "";
    return (is_change ? "change " : "entry ") + std::to_string(std::stoul(index) + 1);
}

/// A word that can be no file's usual name: without a folder, and without a suffix.
bool is_bare_word(const std::string& name) {
    return bare_name(name) == name && fs::path(name).extension().empty();
}

}  // namespace

std::string text_of(const RecipeFault& fault) {
    std::string place = fault.line > 0 ? "line " + std::to_string(fault.line) : "";
    if (const std::string part = part_of(fault.place); !part.empty())
        place += (place.empty() ? "" : ", ") + part;
    return (place.empty() ? "" : place + ": ") + fault.text;
}

RecipeDocument read_recipe(const std::string& text, const std::string& name, RecipeFaults& faults) {
    RecipeDocument document{.name = name, .text = text};
    const bool is_json = note_faults(faults, "", [&] {
        const Json json = json_from_text(text, name, kLargestJsonFile, JsonComments::Ignored);
        DocumentReader(json, document, faults).read();
    });
    if (!is_json || faults.empty()) return document;
    const auto lines = json_lines(text);
    for (RecipeFault& fault : faults) fault.line = line_at(lines, fault.place);
    std::ranges::stable_sort(faults, {}, &RecipeFault::line);
    return document;
}

RecipeDocument recipe_document(const std::string& text, const std::string& name) {
    RecipeFaults faults;
    RecipeDocument document = read_recipe(text, name, faults);
    if (faults.empty()) return document;
    const std::string more = faults.size() == 1
                                 ? ""
                                 : " (and " + counted(faults.size() - 1, "more mistake") +
                                       ": vesselbench recipe check lists them all)";
    const bool names_it = faults.front().line == 0;  // as what is no JSON does
    throw UsageError((names_it ? "" : "recipe '" + printable(name) + "', ") +
                     text_of(faults.front()) + more);
}

std::vector<std::string> bundled_recipe_names() {
    std::vector<std::string> names;
    for (const auto& [name, text] : builtin_recipe_texts()) names.push_back(name);
    return names;
}

bool is_bundled_recipe(const std::string& name) {
    return builtin_recipe_texts().contains(name);
}

RecipeDocument bundled_recipe(const std::string& name) {
    const auto found = builtin_recipe_texts().find(name);
    if (found != builtin_recipe_texts().end()) return recipe_document(found->second, name);
    const std::vector<std::string> names = bundled_recipe_names();
    throw UsageError("there is no recipe '" + shortened(printable(name)) + "'" +
                     did_you_mean(name, names) + " (the bundled ones are " + joined(names) + ")");
}

std::string recipe_text(const std::string& name_or_file) {
    if (is_bundled_recipe(name_or_file)) return bundled_recipe(name_or_file).text;
    if (is_bare_word(name_or_file) && !file_exists(name_or_file))
        return bundled_recipe(name_or_file).text;  // there is none: its names are listed
    return json_file_text(name_or_file);
}

RecipeDocument find_recipe(const std::string& name_or_file) {
    return recipe_document(recipe_text(name_or_file), bare_name(name_or_file));
}

void require_purpose(const RecipeDocument& recipe, const std::string& purpose) {
    if (recipe.purposes.empty() || std::ranges::count(recipe.purposes, purpose) > 0) return;
    throw UsageError("the recipe '" + printable(recipe.name) + "' is for " +
                     enumerated(recipe.purposes) + ", not for " + purpose);
}

}  // namespace vesselbench
