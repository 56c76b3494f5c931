#include "workbench/window/case/preparation.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "workbench/operations/table.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// Takes the part up to a separator from the text's beginning.
std::string taken_word(std::string& text, std::string_view separator) {
    const std::size_t end = text.find(separator);
    if (end == std::string::npos) return "";
    std::string word = text.substr(0, end);
    text.erase(0, end + separator.size());
    return word;
}

/// A line of the command line in the window's words: "openings: clip-opening (0.3 s): ..." as
/// "Clip opening (0.3 s): ...".
std::string in_window_words(const std::string& text) {
    std::string rest = text;
    const std::string step = taken_word(rest, ": ");
    if (known_operation(step) != nullptr) return readable(step) + ": " + rest;
    const std::string operation = taken_word(rest, " (");
    return known_operation(operation) == nullptr ? text : readable(operation) + " (" + rest;
}

}  // namespace

void RecipeMessages::add(Message message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
}

std::vector<Message> RecipeMessages::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

Task<Nothing> Preparation::start(SessionRunner& runner,
                                 const std::shared_ptr<RecipeMessages>& messages) const {
    const bool first = next == 0, last = next + 1 == recipe.size();
    return runner.submit([entry = recipe[next], purpose = purpose, project = project, first, last,
                          messages](Session& session, const Progress& progress) {
        const Teller note([&](const std::string& text) { messages->add(message_from(text)); },
                          [&](const Diagnostic& warning) { messages->add(make_message(warning)); });
        if (first) begin_purpose(project, purpose);
        apply_recipe(session, {entry}, purpose, note, progress);
        if (last) end_purpose(project, purpose);
        return Nothing{};
    });
}

ResumedRecipe missing_entries(const Snapshot& snapshot, const std::optional<Input>& input,
                              const Scene* scene, const std::string& purpose,
                              const std::vector<std::string>& done) {
    RecipeUse use = {scene != nullptr && scene->image ? "image" : "surface", purpose};
    if (scene != nullptr && scene->mask) use.insert(use.end(), {"mask", kDrawnMask});
    const nlohmann::ordered_json own = input ? own_recipe(*input, purpose) : nullptr;
    Recipe recipe = own.is_null() ? default_recipe(use) : recipe_from_json(own, use);
    std::erase_if(recipe, [](const RecipeEntry& entry) {  // the project begins with its source
        const std::optional<InputKind> loads = entry.given.operation().recipe.loads;
        return loads.has_value() && loads != InputKind::Neighbour;
    });
    return resumed_recipe(recipe, snapshot, purpose, done);
}

Message message_from(const std::string& text) {
    return make_message(MessageKind::Remark, in_window_words(text));
}

}  // namespace vesselbench
