#include "workbench/window/case/rerun.h"

#include <cmath>
#include <set>

#include "geometry/kernel/wording.h"
#include "workbench/session/edit_place.h"

namespace vesselbench {

namespace {

constexpr double kMinute = 60.0;  ///< [s]

void add(const Snapshot& snapshot, const EditRef& edit, Rerun& rerun) {
    ++rerun.edits;
    const auto past = snapshot.past->find(edit);
    if (past != snapshot.past->end() && past->second.result)
        rerun.seconds += past->second.result->duration;
}

/// As exact as an estimate is.
std::string time_text(double seconds) {
    if (seconds < 1.0) return "less than a second";
    if (seconds < 10.0) return "about " + formatted(seconds, "%.0f s");
    if (seconds < kMinute) return "about " + formatted(5.0 * std::round(seconds / 5.0), "%.0f s");
    return "about " + formatted(std::ceil(seconds / kMinute), "%.0f min");
}

}  // namespace

Rerun pending_rerun(const Snapshot& snapshot, const std::string& variant) {
    Rerun rerun;
    for (const LogEntry& entry : snapshot.log)
        if (entry.status == EditStatus::Pending && is_part_of(entry.edit.place, variant))
            add(snapshot, entry.edit.edit, rerun);
    return rerun;
}

Rerun rerun_after(const EditSite& site, const Snapshot& snapshot, const std::string& variant) {
    const auto input = input_of(site, *snapshot.history, variant);
    if (!input) return pending_rerun(snapshot, variant);
    std::set<EditRef> before;
    for (const HistoryEntry& entry : input->before) before.insert(entry.edit);
    Rerun rerun;
    for (const LogEntry& entry : snapshot.log)
        if (is_part_of(entry.edit.place, variant) && entry.edit.edit.id != site.edit &&
            (entry.status == EditStatus::Pending || !before.contains(entry.edit.edit)))
            add(snapshot, entry.edit.edit, rerun);
    return rerun;
}

std::string rerun_text(const Rerun& rerun) {
    return counted(rerun.edits, "edit") + ", " + time_text(rerun.seconds);
}

}  // namespace vesselbench
