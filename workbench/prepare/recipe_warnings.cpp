#include "workbench/prepare/recipe_warnings.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "workbench/case/diagnostic_json.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kName = "the stored warnings";

/// A list; empty if the project has none.
Json stored_list(const std::filesystem::path& project) {
    const std::string text = stored_text(project, StoredText::Warnings);
    if (text.empty()) return Json::array();
    Json list = json_from_text(text, kName);
    if (!list.is_array()) refuse_json(list, kName, "a list");
    for (const Json& warning : list)
        if (!warning.is_object()) refuse_json(warning, kName, "a list of objects");
    return list;
}

/// True for warnings about the same thing, of which the later one counts.
bool same_entry(const Json& a, const Json& b) {
    return std::ranges::all_of(
        std::array{"operation", "step", "variant", "edit", "revision"},
        [&](const char* key) { return a.value(key, Json()) == b.value(key, Json()); });
}

/// \param log of a variant \param variant the same
bool holds(const Json& warning, const std::vector<LogEntry>& log, const std::string& variant) {
    const Json its = warning.value("variant", Json());
    if (!its.is_null() && json_value<std::string>(its, kName) != variant) return false;
    const auto operation = json_value<std::string>(warning.value("operation", Json()), kName);
    const auto step = json_value<std::string>(warning.value("step", Json()), kName);
    const Json edit = warning.value("edit", Json());
    if (edit.is_null())
        return std::ranges::none_of(log, [&](const LogEntry& entry) {
            return entry.edit.operation == operation && to_string(entry.edit.place.step) == step;
        });
    const EditRef ref{json_value<EditId>(edit, kName),
                      json_value<int>(warning.value("revision", Json()), kName)};
    return std::ranges::any_of(log, [&](const LogEntry& entry) { return entry.edit.edit == ref; });
}

/// Old projects have its text only.
Diagnostic diagnostic_in(const Json& warning) {
    const char* key = warning.contains("diagnostic") ? "diagnostic" : "text";
    return diagnostic_from(warning.value(key, Json()), kName);
}

}  // namespace

void keep_warning(const std::filesystem::path& project, const RecipeWarning& warning) {
    Json added = {{"operation", warning.operation}, {"step", to_string(warning.step)}};
    if (!warning.variant.empty()) added["variant"] = warning.variant;
    if (warning.edit) {
        added["edit"] = warning.edit->id;
        added["revision"] = warning.edit->revision;
    }
    added["diagnostic"] = diagnostic_json(warning.diagnostic);
    Json list = Json::array();
    for (Json& earlier : stored_list(project))
        if (!same_entry(earlier, added)) list.push_back(std::move(earlier));
    list.push_back(std::move(added));
    store_text(project, StoredText::Warnings, text_from_json(list));
}

std::vector<Diagnostic> kept_warnings(const std::filesystem::path& project, const Session& session,
                                      const std::string& variant) {
    std::vector<Diagnostic> warnings;
    const std::vector<LogEntry> log = session.log(variant);
    for (const Json& warning : stored_list(project))
        if (holds(warning, log, variant)) warnings.push_back(diagnostic_in(warning));
    return warnings;
}

}  // namespace vesselbench
