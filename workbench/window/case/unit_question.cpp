#include "workbench/window/case/unit_question.h"

#include <nlohmann/json.hpp>

namespace vesselbench {

namespace {

using nlohmann::json;

/// A text of a report; empty: it has none of this name. Reports may come from other versions.
std::string text_in(const json& report, const char* name) {
    if (!report.is_object() || !report.contains(name) || !report[name].is_string()) return "";
    return report[name].get<std::string>();
}

}  // namespace

std::optional<UnitQuestion> unit_question(const Snapshot& snapshot) {
    for (const LogEntry& entry : snapshot.log) {
        if (entry.edit.place.step != Step::Source || !entry.result) continue;
        const json report = json::parse(entry.result->report, nullptr, false);
        std::string doubt = text_in(report, "units_doubt");
        if (!doubt.empty())
            return UnitQuestion{entry.edit.edit.id, std::move(doubt), text_in(report, "units")};
    }
    return std::nullopt;
}

}  // namespace vesselbench
