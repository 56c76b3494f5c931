#include "workbench/prepare/entry_reader.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/near_names.h"
#include "workbench/case/purposes.h"
#include "workbench/operations/table.h"
#include "workbench/review/acceptance.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

const Names kEntryKeys = {"operation",     "arguments",   "step",      "optional",
                          "unless_closed", "unless_made", "otherwise", "when"};
/// Arguments of the ways to extract that take the mask as a region for intensities.
const Names kRegionArguments = {"threshold", "iso", "inside", "dilation"};
const Names kGateKeys = {"require", "when"};
const Names kMadeKeys = {"operation", "arguments"};
const Names kChangeKeys = {"operation", "step", "arguments"};

bool word_holds(const std::string& word, const RecipeUse& use) {
    const bool negated = word.starts_with("no-");
    const std::string name = negated ? word.substr(3) : word;
    const Names words = use_words();
    if (std::ranges::count(words, name) == 0)
        throw UsageError("\"when\" contains '" + shortened(printable(word)) + "'" +
                         did_you_mean(name, words) + "; it may contain " + joined(words) +
                         ", each also with the prefix no-");
    return (std::ranges::count(use, name) > 0) != negated;
}

Names words_in(const Json& when) {
    if (when.is_string()) return {when.get<std::string>()};
    if (!when.is_array()) refuse_json(when, "when", "a text or a list of texts");
    return json_value<Names>(when, "when");
}

/// "$purpose" as the purpose's name; other values as they are.
Json with_purpose(const std::string& name, const Json& value, const RecipeUse& use) {
    if (value != "$purpose") return value;
    const auto purpose = std::ranges::find_if(
        purposes(), [&](const Purpose& p) { return std::ranges::count(use, p.name) > 0; });
    if (purpose == purposes().end())
        throw UsageError(name + " is $purpose, but the recipe is for no purpose");
    return purpose->name;
}

constexpr const char* kMask = "$mask";

/// "$mask" as the method of extracting: the wall if a drawn mask is it, unless the entry has an
/// argument of another way to use the mask.
Json with_mask(const Json& arguments, const Json& value, const RecipeUse& use) {
    if (value != kMask) return value;
    const bool is_wall = std::ranges::any_of(
        use, [](const std::string& word) { return word == kWallMask || word == kDrawnMask; });
    const bool other_way = std::ranges::any_of(
        kRegionArguments, [&](const std::string& name) { return arguments.contains(name); });
    return is_wall && !other_way ? "wall" : "auto";
}

/// Reads the parts of an object of a recipe, and notes what is wrong about each.
class EntryReader {
public:
    /// \param called the object in error texts
    EntryReader(const Json& json, std::string place, RecipeFaults& faults,
                std::string called = "the entry")
        : json_(json), place_(std::move(place)), faults_(faults), called_(std::move(called)) {}

    void refuse_other_keys(const Names& keys) {
        for (const auto& [key, value] : json_.items())
            if (std::ranges::count(keys, key) == 0)
                fault(key, "there is no key '" + shortened(printable(key)) + "'" +
                               did_you_mean(key, keys) + " (here, the keys are " + joined(keys) +
                               ")");
    }

    bool flag(const char* key) {
        bool value = false;
        read(key, [&](const Json& json) { value = json_value<bool>(json, key); });
        return value;
    }

    bool is_used(const RecipeUse& use) {
        bool used = true;
        read("when", [&](const Json& json) {
            for (const std::string& word : words_in(json)) used = word_holds(word, use) && used;
        });
        return used;
    }

    /// \return null: it names none
    const Operation* operation() {
        if (!json_.contains("operation")) fault("", called_ + " has no \"operation\"");
        const Operation* found = nullptr;
        read("operation", [&](const Json& json) {
            found = &find_operation(json_value<std::string>(json, "operation"));
        });
        return found;
    }

    /// An object of arguments; those that are wrong are left out.
    GivenArguments arguments(const char* key, const Operation& operation,
                             const RecipeUse* use = nullptr) {
        GivenArguments given(operation);
        read(key, [&](const Json& object) {
            if (!object.is_object()) return void(arguments_from_json(operation, object));
            for (const auto& [name, value] : object.items())
                note_faults(faults_, place_ + "/" + key + "/" + name, [&] {
                    const Json one =
                        use ? with_mask(object, with_purpose(name, value, *use), *use) : value;
                    given.set(arguments_from_json(operation, Json{{name, one}}));
                });
        });
        return given;
    }

    std::optional<Step> step(const Operation& operation) {
        std::optional<Step> step;
        read("step", [&](const Json& json) {
            step = step_from(json_value<std::string>(json, "step"));
            if (std::ranges::count(operation.allowed, *step) == 0)
                throw UsageError(operation.name + " is not allowed in the step " +
                                 to_string(*step) + " (its steps are " +
                                 joined(step_names(operation.allowed)) + ")");
        });
        return step;
    }

    /// Edits that replace the entry.
    std::vector<GivenArguments> made() {
        std::vector<GivenArguments> made;
        const auto take = [&](const Json& json, const std::string& place) {
            if (!json.is_object()) refuse_json(json, "unless_made", "an object");
            EntryReader inner(json, place, faults_, "unless_made");
            inner.refuse_other_keys(kMadeKeys);
            if (const Operation* operation = inner.operation())
                made.push_back(inner.arguments("arguments", *operation));
        };
        read("unless_made", [&](const Json& json) {
            const std::string place = place_ + "/unless_made";
            if (!json.is_array()) return take(json, place);
            for (std::size_t i = 0; i < json.size(); ++i)
                take(json[i], place + "/" + std::to_string(i));
        });
        return made;
    }

    std::size_t reviewers() {
        std::size_t count = 0;
        read("require", [&](const Json& json) {
            count = required_reviewers(json_value<std::string>(json, "require"), "require");
        });
        return count;
    }

private:
    void fault(const std::string& key, const std::string& text) {
        faults_.push_back({key.empty() ? place_ : place_ + "/" + key, text});
    }

    /// Reads the value of a key that is there.
    template <class Read>
    void read(const char* key, Read reading) {
        const auto found = json_.find(key);
        if (found != json_.end())
            note_faults(faults_, place_ + "/" + key, [&] { reading(*found); });
    }

    const Json& json_;
    std::string place_;
    RecipeFaults& faults_;
    std::string called_;
};

RecipeEntry entry_of(EntryReader& reader, const Json& json, const Operation& operation,
                     const RecipeUse& use) {
    RecipeEntry entry{.given = reader.arguments("arguments", operation, &use),
                      .step = reader.step(operation),
                      .optional = reader.flag("optional"),
                      .unless_closed = reader.flag("unless_closed"),
                      .unless_made = reader.made()};
    const auto arguments = json.find("arguments");
    entry.if_drawn = arguments != json.end() && arguments->is_object() &&
                     arguments->value("method", Json()) == kMask &&
                     entry.given->is_word("method", "wall") &&
                     std::ranges::count(use, kWallMask) == 0;
    if (json.contains("otherwise") && !json["otherwise"].empty())
        entry.otherwise = reader.arguments("otherwise", operation);
    return entry;
}

bool is_object(const Json& json, const std::string& place, RecipeFaults& faults) {
    if (!json.is_object()) faults.push_back({place, "it is not a JSON object"});
    return json.is_object();
}

}  // namespace

bool limits_region(std::string_view setting) {
    const auto names = [&](std::string_view operation, const Names& parameters) {
        return std::ranges::any_of(parameters, [&](const std::string& parameter) {
            return setting.starts_with(std::string(operation) + "." + parameter + "=");
        });
    };
    Names own = kRegionArguments;
    own.emplace_back("method");
    return names("extract-surface", own) || names("load-image", {"mask_iso", "mask_inside"});
}

std::vector<std::string> use_words() {
    Names words = {"surface", "image", "mask"};
    for (const Purpose& purpose : purposes()) words.push_back(purpose.name);
    return words;
}

ReadEntry read_entry(const Json& json, const RecipeUse& use, const std::string& place,
                     RecipeFaults& faults) {
    ReadEntry read;
    if (!is_object(json, place, faults)) return read;
    EntryReader reader(json, place, faults);
    const bool is_gate = json.contains("require");
    reader.refuse_other_keys(is_gate ? kGateKeys : kEntryKeys);
    read.used = reader.is_used(use);
    if (is_gate)
        read.reviewers = reader.reviewers();
    else if (const Operation* operation = reader.operation())
        read.entry = entry_of(reader, json, *operation, use);
    return read;
}

std::optional<RecipeEntry> read_change(const Json& json, const std::string& place,
                                       RecipeFaults& faults) {
    if (!is_object(json, place, faults)) return std::nullopt;
    EntryReader reader(json, place, faults);
    reader.refuse_other_keys(kChangeKeys);
    const Operation* operation = reader.operation();
    if (operation == nullptr) return std::nullopt;
    return RecipeEntry{.given = reader.arguments("arguments", *operation),
                       .step = reader.step(*operation)};
}

}  // namespace vesselbench
