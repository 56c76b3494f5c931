#include "workbench/prepare/prepared_purposes.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/operations/table.h"
#include "workbench/session/edit_place.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPurposes = "the stored purposes";

void store_purposes(const std::filesystem::path& project, const PreparedPurposes& purposes) {
    store_text(project, StoredText::Purposes,
               Json({{"done", purposes.done}, {"last", purposes.last}}).dump());
}

}  // namespace

PreparedPurposes prepared_purposes(const std::filesystem::path& project) {
    const std::string text = stored_text(project, StoredText::Purposes);
    if (text.empty()) return {};
    const Json json = json_from_text(text, kPurposes);
    JsonFields fields(json, kPurposes);
    PreparedPurposes purposes{fields.required<std::vector<std::string>>("done"),
                              fields.required<std::string>("last")};
    for (const std::string& name : purposes.done) require_plain_name(name, "a purpose");
    if (!purposes.last.empty()) require_plain_name(purposes.last, "a purpose");
    return purposes;
}

void begin_purpose(const std::filesystem::path& project, const std::string& purpose) {
    PreparedPurposes purposes = prepared_purposes(project);
    purposes.last = purpose;
    store_purposes(project, purposes);
}

void end_purpose(const std::filesystem::path& project, const std::string& purpose) {
    PreparedPurposes purposes = prepared_purposes(project);
    purposes.last = purpose;
    if (std::ranges::count(purposes.done, purpose) == 0) purposes.done.push_back(purpose);
    store_purposes(project, purposes);
}

std::string variant_of(const std::filesystem::path& project, const std::string& asked,
                       const History& history) {
    const PreparedPurposes purposes = prepared_purposes(project);
    if (asked.empty()) return variant_meant(purposes.last, history);
    std::vector<std::string> known = history.variants();
    known.insert(known.end(), purposes.done.begin(), purposes.done.end());
    if (known.empty()) known = purpose_names();  // models that shared steps alone make
    if (asked != purposes.last && std::ranges::count(known, asked) == 0)
        throw UsageError("the project has no variant '" + shortened(printable(asked)) +
                         "'; it has " + enumerated(known));
    return asked;
}

std::vector<std::string> other_purposes(const Snapshot& now, std::vector<std::string> done,
                                        const std::string& purpose) {
    // Models whose edits were all undone are gone, whatever was prepared once.
    if (std::ranges::none_of(now.log, [](const LogEntry& entry) {
            return entry.edit.place.variant.empty() &&
                   !find_operation(entry.edit.operation).recipe.loads;
        }))
        done.clear();
    for (const std::string& variant : now.history->variants())
        if (std::ranges::count(done, variant) == 0) done.push_back(variant);
    std::erase(done, purpose);
    return done;
}

}  // namespace vesselbench
