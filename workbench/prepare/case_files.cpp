#include "workbench/prepare/case_files.h"

#include <functional>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "geometry/kernel/regular_file.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What becomes of a file's text; `what` names its place in messages.
using ChangeFile = std::function<std::string(const std::string& file, const std::string& what)>;

void change_files(const Operation& operation, Json& arguments, const ChangeFile& change) {
    if (!arguments.is_object()) return;
    for (const Parameter& parameter : operation.parameters) {
        const auto named = arguments.find(parameter.name);
        if (parameter.type != ParameterType::File || named == arguments.end() ||
            !named->is_string())
            continue;
        *named = change(named->get<std::string>(),
                        "the recipe's " + operation.name + " " + parameter.name);
    }
}

void change_entry(Json& entry, const ChangeFile& change) {
    if (!entry.is_object()) return;
    const auto name = entry.find("operation");
    const Operation* operation = name != entry.end() && name->is_string()
                                     ? known_operation(name->get<std::string>())
                                     : nullptr;
    for (const char* key : {"arguments", "otherwise"})
        if (const auto given = entry.find(key); operation != nullptr && given != entry.end())
            change_files(*operation, *given, change);
    const auto made = entry.find("unless_made");
    if (made != entry.end() && made->is_array())
        for (Json& one : *made) change_entry(one, change);
    else if (made != entry.end())
        change_entry(*made, change);
}

Json with_files_changed(Json recipe, const ChangeFile& change) {
    if (recipe.is_array())
        for (Json& entry : recipe) change_entry(entry, change);
    return recipe;
}

}  // namespace

fs::path case_file(const fs::path& folder, JsonFields& fields, const char* key) {
    const auto name = fields.optional<std::string>(key);
    if (!name) return {};
    fs::path file = inner_file(folder, *name, "its " + std::string(key));
    if (!file_exists(file))
        throw IoError("its " + std::string(key) + " '" + file.filename().string() +
                      "' does not exist");
    return file;
}

Json recipe_in(const fs::path& folder, Json recipe) {
    return with_files_changed(std::move(recipe),
                              [&](const std::string& file, const std::string& what) {
                                  return inner_file(folder, file, what).string();
                              });
}

Json with_file_names(Json recipe) {
    return with_files_changed(std::move(recipe), [](const std::string& file, const std::string&) {
        return fs::path(file).filename().string();
    });
}

}  // namespace vesselbench
