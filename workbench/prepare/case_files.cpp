#include "workbench/prepare/case_files.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "geometry/kernel/regular_file.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void place_files(const fs::path& folder, const Operation& operation, Json& arguments) {
    if (!arguments.is_object()) return;
    for (const Parameter& parameter : operation.parameters) {
        const auto named = arguments.find(parameter.name);
        if (parameter.type != ParameterType::File || named == arguments.end() ||
            !named->is_string())
            continue;
        const std::string what = "the recipe's " + operation.name + " " + parameter.name;
        *named = inner_file(folder, named->get<std::string>(), what).string();
    }
}

void place_files(const fs::path& folder, Json& entry) {
    if (!entry.is_object()) return;
    const auto name = entry.find("operation");
    const Operation* operation = name != entry.end() && name->is_string()
                                     ? known_operation(name->get<std::string>())
                                     : nullptr;
    for (const char* key : {"arguments", "otherwise"})
        if (const auto given = entry.find(key); operation != nullptr && given != entry.end())
            place_files(folder, *operation, *given);
    if (const auto made = entry.find("unless_made"); made != entry.end())
        place_files(folder, *made);
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
    if (recipe.is_array())
        for (Json& entry : recipe) place_files(folder, entry);
    return recipe;
}

}  // namespace vesselbench
