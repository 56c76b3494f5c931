#include "workbench/review/finding_items.h"

#include <algorithm>

#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/readable_name.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
#include "workbench/findings/question.h"

namespace vesselbench {

namespace {

/// Below every score of an edit's own reasons.
constexpr double kMostScore = 0.2;

const LogEntry* last_run(const std::vector<LogEntry>& log) {
    const auto last = std::find_if(log.rbegin(), log.rend(),
                                   [](const LogEntry& entry) { return entry.result != nullptr; });
    return last == log.rend() ? nullptr : &*last;
}

/// Certainty, what was measured, and what it may be.
std::string why_of(const Finding& finding) {
    std::string why = certainty_words(finding) + ". " +
                      readable_sentence(worded(finding.evidence, {.window = true}));
    for (const Reading& reading : finding.readings)
        why += ". " + readable_sentence(reading_words(reading, true));
    return why;
}

}  // namespace

std::vector<Finding> open_findings(Session& session, const std::vector<LogEntry>& log,
                                   const Progress& progress) {
    const LogEntry* last = last_run(log);
    if (last == nullptr) return {};
    const Scene scene = session.result_scene(last->result->id, progress.part(0.0, 0.1));
    if (!scene.surface || scene.surface->empty()) return {};
    FindingSearch found = find_findings(scene, stated_ends(log), progress.part(0.1, 1.0));
    const ProjectFile& project = session.project();
    if (project.name().empty()) return found.findings;
    return judged(std::move(found), stored_dismissals(project.folder() / project.name())).open;
}

std::vector<QueueItem> finding_items(const std::vector<Finding>& findings,
                                     const std::vector<LogEntry>& log) {
    std::vector<QueueItem> items;
    const LogEntry* last = last_run(log);
    if (last == nullptr) return items;
    for (const Finding& finding : findings)
        items.push_back({.kind = "finding",
                         .edit = last->edit.edit.id,
                         .title = title_of(finding),
                         .why = why_of(finding),
                         .score = kMostScore * finding.certainty,
                         .place = finding.place,
                         .radius = finding.size,
                         .folded = finding.certainty < kListed});
    return items;
}

std::vector<QueueItem> finding_items(Session& session, const std::vector<LogEntry>& log,
                                     const Progress& progress) {
    return finding_items(open_findings(session, log, progress), log);
}

}  // namespace vesselbench
