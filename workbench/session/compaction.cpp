#include "workbench/session/compaction.h"

#include <set>

#include "geometry/kernel/errors.h"
#include "workbench/project/project.h"
#include "workbench/session/login_name.h"

namespace vesselbench {

namespace {

void keep_with_inputs(const History& history, ResultId id, std::set<ResultId>& kept) {
    for (; id != 0 && kept.insert(id).second;) id = history.results().at(id).input;
}

std::set<ResultId> needed_results(const ProjectFile& project, const History& history) {
    std::set<ResultId> kept;
    for (const HistoryEntry& entry : history.entries())
        if (entry.status == EditStatus::Done) kept.insert(entry.result);
    for (const auto& [id, result] : history.results())
        if (!result.dropped && !project.sources(result.edit).empty())
            keep_with_inputs(history, id, kept);
    return kept;
}

}  // namespace

Compaction compact_project(const std::filesystem::path& file) {
    ProjectFile project = ProjectFile::open(file);
    if (!project.read_only_reason().empty()) throw IoError(project.read_only_reason());
    project.set_author(login_name());
    const History history = project.history();
    const std::set<ResultId> kept = needed_results(project, history);
    Compaction done{.before = std::filesystem::file_size(file)};
    for (const auto& [id, result] : history.results())
        if (!result.dropped && result.stale_reason.empty() && !kept.contains(id))
            ++done.dropped[project.edit(result.edit).operation];
    project.drop_scenes(kept);
    done.after = std::filesystem::file_size(file);
    return done;
}

}  // namespace vesselbench
