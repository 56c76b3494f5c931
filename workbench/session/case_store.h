#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "workbench/project/project.h"
#include "workbench/project/source_files.h"
#include "workbench/session/scene_cache.h"
#include "workbench/session/snapshot.h"
#include "workbench/worker/worker.h"

namespace vesselbench {

/// The case of a session: its project file, its current history, and the records and scenes in
/// memory. Not thread-safe; the snapshots it returns are.
class CaseStore {
public:
    /// \param find of operations, which say what stored arguments are
    /// \param scene_bytes [bytes] of scenes held in memory
    CaseStore(ProjectFile project, OperationLookup find, std::size_t scene_bytes);

    [[nodiscard]] const History& history() const { return *history_; }

    [[nodiscard]] const ProjectFile& project() const { return project_; }

    [[nodiscard]] bool only_reads() const { return !project_.read_only_reason().empty(); }

    /// \throw IoError with the reason if the case is read-only
    void check_writable() const;

    /// Makes `next` the history and stores its data, in one transaction.
    /// \param change without its histories
    /// \throw IoError if it cannot be written; everything is then unchanged
    void commit(History next, ProjectChange change);

    /// Enters results of pending edits. A read-only case keeps them in memory.
    void commit_results(History next, const std::vector<NewResult>& results);

    /// Replaces the note of an edit revision.
    /// \throw IoError if the case is read-only or cannot be written
    void set_note(EditRef edit, const std::string& note);

    // As the project's functions of the same names.
    void set_author(const std::string& author) { project_.set_author(author); }

    void record(const OutsideEntry& entry) { project_.record(entry); }

    bool add_verdicts(const StoredVerdicts& verdicts, const std::string& hash,
                      const OutsideEntry& entry) {
        return project_.add_verdicts(verdicts, hash, entry);
    }

    /// \throw IoError as ProjectFile::fold_log
    void fold_log() const { project_.fold_log(); }

    /// Removes the project's file; the case can then only be destroyed.
    void discard() { project_.discard(); }

    /// True if the result is kept in memory because the case is read-only.
    [[nodiscard]] bool is_own(ResultId id) const { return own_scenes_.contains(id); }

    /// \throw InvalidInput if the project lacks it
    [[nodiscard]] EditRecord edit(EditRef edit);

    [[nodiscard]] std::shared_ptr<const ResultRecord> record(ResultId id);

    /// Where the files of edits may be.
    [[nodiscard]] FilePlaces files() const { return {project_.folder(), read_}; }

    /// Remembers the files that an edit or a preview has read as long as the session lives.
    void keep_places(const std::vector<SourceFile>& sources, const Arguments& located) {
        vesselbench::remember(read_, sources, located);
    }

    /// Files that edits read are looked for here, too.
    void keep_place(const std::string& hash, const std::filesystem::path& file) {
        read_[hash] = std::filesystem::absolute(file);
    }

    /// The scene of a result if it is in memory.
    [[nodiscard]] std::optional<Scene> at_hand(ResultId id);

    void keep(ResultId id, const Scene& scene) { cache_.put(id, scene); }

    /// A snapshot of the case. Unchanged data is shared with the previous one.
    [[nodiscard]] std::shared_ptr<const Snapshot> snapshot();

private:
    void remember(std::vector<EditRef> edits, std::vector<ResultId> results);
    void remember(std::vector<EditRef> edits);
    [[nodiscard]] Arguments typed(const std::string& operation, Arguments stored) const;
    void renew_past();
    [[nodiscard]] std::map<std::string, Scene> scenes_at_hand();

    ProjectFile project_;
    OperationLookup find_;
    std::shared_ptr<const History> history_;
    SceneCache cache_;
    ReadFiles read_;
    std::map<EditRef, EditRecord> edits_;  ///< those read or created so far
    std::map<ResultId, std::shared_ptr<const ResultRecord>> records_;
    std::map<ResultId, std::optional<Scene>> own_scenes_;  ///< none: a stale result
    std::shared_ptr<const std::map<EditRef, PastEdit>> past_;
    std::size_t past_results_ = 0;  ///< number of results when `past_` was made
};

}  // namespace vesselbench
