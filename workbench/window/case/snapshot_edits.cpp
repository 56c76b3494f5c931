#include "workbench/window/case/snapshot_edits.h"

#include <algorithm>
#include <set>

#include "workbench/report/log_json.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// The newest edit that a condition holds for; null: none.
const LogEntry* newest_of(const Snapshot& snapshot, const auto& condition) {
    const LogEntry* newest = nullptr;
    for (const LogEntry& entry : snapshot.log)
        if (condition(entry.edit) &&
            (newest == nullptr || newest->edit.edit.id < entry.edit.edit.id))
            newest = &entry;
    return newest;
}

}  // namespace

bool same_edits(const Snapshot& a, const Snapshot& b) {
    return a.history == b.history && a.past == b.past && a.project == b.project &&
           a.read_only_reason == b.read_only_reason;
}

std::string newest_variant(const Snapshot& snapshot, const std::string& otherwise) {
    const LogEntry* newest =
        newest_of(snapshot, [](const EditRecord& edit) { return !edit.place.variant.empty(); });
    if (newest != nullptr) return newest->edit.place.variant;
    return otherwise.empty() ? kDefaultVariant : otherwise;
}

std::string changed_text(const EditRecord& edit, const ResultRecord& result) {
    const std::string change = effect_text(result);
    return readable(edit.operation) + (change.empty() ? "" : ": " + change);
}

std::vector<LogEntry> run_since(const Snapshot& before, const Snapshot& now) {
    std::set<EditId> pending;
    for (const LogEntry& entry : before.log)
        if (entry.status == EditStatus::Pending) pending.insert(entry.edit.edit.id);
    std::vector<LogEntry> run;
    for (const LogEntry& entry : now.log)
        if (entry.status != EditStatus::Pending && pending.contains(entry.edit.edit.id))
            run.push_back(entry);
    return run;
}

const LogEntry* newest_edit(const Snapshot& snapshot, const std::string& operation) {
    return newest_of(snapshot, [&](const EditRecord& edit) { return edit.operation == operation; });
}

std::string edits_between(const Snapshot& a, const Snapshot& b) {
    std::vector<EditRecord> differing;
    const auto add_those_missing = [&](const Snapshot& from, const Snapshot& in) {
        for (const LogEntry& entry : from.log) {
            const auto same = [&](const LogEntry& other) { return other.edit == entry.edit; };
            const auto known = [&](const EditRecord& e) { return e.edit.id == entry.edit.edit.id; };
            if (std::ranges::none_of(in.log, same) && std::ranges::none_of(differing, known))
                differing.push_back(entry.edit);
        }
    };
    add_those_missing(a, b);
    add_those_missing(b, a);
    if (differing.empty()) return "an edit";
    const EditRecord& first = differing.front();
    const std::string more =
        differing.size() == 1 ? "" : ", and " + std::to_string(differing.size() - 1) + " more";
    return "edit " + std::to_string(first.edit.id) + ", " + readable(first.operation) + more;
}

}  // namespace vesselbench
