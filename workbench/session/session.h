#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "workbench/session/live_edit.h"
#include "workbench/session/preview.h"
#include "workbench/session/replay.h"
#include "workbench/session/session_options.h"
#include "workbench/session/snapshot.h"

namespace vesselbench {

/// A case being worked on: history, project file and running operations in one. Command line,
/// recipes, tests and the window all use it. Every change is in the project file, by one
/// transaction, before the call returns. A call that throws or is cancelled leaves everything
/// unchanged, except in scene(), scene_after() and replay(): pending edits that have run by then
/// stay done. Not thread-safe; a window's session belongs to a SessionRunner.
class Session {
public:
    /// Creates a new project file.
    /// \param make_room called once no other process can open a project of this path for writing:
    /// it may rename an earlier one
    /// \throw IoError if it exists, is open in another process, or cannot be written
    [[nodiscard]] static Session create(const std::filesystem::path& project,
                                        SessionOptions options = {},
                                        const std::function<void()>& make_room = {});

    /// Opens a project. If another process has it open for writing, or it cannot be written, this
    /// session only reads; read_only_reason() says why.
    /// \throw IoError if it cannot be read, InvalidInput if it is not a project, damaged, or of a
    ///        newer version
    [[nodiscard]] static Session open(const std::filesystem::path& project,
                                      SessionOptions options = {});

    /// A session without a file; save_as() writes one.
    [[nodiscard]] static Session unsaved(SessionOptions options = {});

    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;
    ~Session();

    /// Empty if this session may write.
    [[nodiscard]] const std::string& read_only_reason() const;

    /// Runs an operation and enters it into the history: preview() and commit() in one. Pending
    /// edits before it run first and are entered with it; later ones become pending.
    /// \throw UsageError on wrong arguments, step or variant; what the operation throws; IoError if
    /// the session only reads or the project cannot be written
    LogEntry apply(const std::string& operation, const Arguments& given,
                   const EditOptions& options = {}, Progress progress = {});

    /// The same for arguments that are checked already: texts of a command line, a recipe.
    LogEntry apply(const GivenArguments& given, const EditOptions& options = {},
                   Progress progress = {});

    /// Runs an edit of the current state with other arguments: its next revision. Later edits
    /// become pending.
    /// \param given all its arguments; for files read before, the names suffice
    /// \throw as apply()
    LogEntry change_edit(EditId id, const Arguments& given, const EditOptions& options = {},
                         Progress progress = {});

    /// Runs the same as apply() and change_edit() without entering anything. A read-only session
    /// may preview, too.
    /// \throw UsageError; what the operation throws
    [[nodiscard]] Preview preview(const std::string& operation, const Arguments& given,
                                  const EditOptions& options = {}, Progress progress = {});
    [[nodiscard]] Preview preview_change(EditId id, const Arguments& given,
                                         const EditOptions& options = {}, Progress progress = {});

    /// Enters a previewed edit without running it again.
    /// \throw UsageError if the edits before it are no longer those it ran on; IoError if the
    /// session only reads or the project cannot be written
    LogEntry commit(const Preview& preview);

    /// Starts an operation live. Pending edits before it run in memory.
    /// \throw UsageError if it has no live form; as preview()
    [[nodiscard]] LiveEdit start_live(const std::string& operation, const Arguments& given,
                                      const EditOptions& options = {}, Progress progress = {});

    /// The result of everything added to a live edit, with its figures; the live edit may continue.
    [[nodiscard]] Preview preview(LiveEdit& live, Progress progress = {});

    /// Pending edits, and those that no longer apply, will run with the arguments they were given,
    /// and choose again what they chose by themselves (an opening's plane, a radius): each gets a
    /// new revision. A change of the model's unit does this by itself.
    /// \return the number of these edits
    /// \throw IoError as apply()
    std::size_t decide_anew(const EditOptions& options = {});

    /// Leaves an edit out; later edits become pending.
    /// \throw UsageError if there is no such edit
    void remove_edit(EditId id);

    /// To the parent state, the child last visited, or any state; with an edit: back to before it
    /// was made or changed, forward to where it was. No scene is read.
    /// \throw UsageError
    void undo();
    void undo(EditId before);
    void redo();
    void redo(EditId to);
    void jump(StateId state);

    /// The scene of a variant. Pending edits run first; those that no longer apply become stale. A
    /// read-only session keeps their results in memory.
    [[nodiscard]] Scene scene(const std::string& variant = kDefaultVariant, Progress progress = {});

    /// The scene right after one edit of the current state; pending edits up to it run first.
    [[nodiscard]] Scene scene_after(EditId id, Progress progress = {});

    /// The scene of a variant in any state, as far as its edits have run there: before the first
    /// pending one. Runs nothing, and the current state stays.
    /// \throw UsageError if there is no such state
    [[nodiscard]] Scene known_scene(StateId state, const std::string& variant = kDefaultVariant,
                                    Progress progress = {});

    /// The scene of a result, which any state may have. Runs nothing, and the current state stays.
    /// \throw UsageError if there is no such result
    [[nodiscard]] Scene result_scene(ResultId id, Progress progress = {});

    /// Replaces the note on a revision of an edit of any state; empty: none. No state is made: a
    /// note changes no model.
    /// \throw UsageError if there is no such edit; IoError if the session only reads or the project
    /// cannot be written
    void set_note(EditRef edit, const std::string& note);

    /// The project as it is stored: its id, the head of its record, verdicts, digests of results.
    [[nodiscard]] const ProjectFile& project() const;

    /// As ProjectFile::record() and add_verdicts(), by the session's author.
    /// \throw IoError if the session only reads or the project cannot be written
    void record(const OutsideEntry& entry);
    bool add_verdicts(const StoredVerdicts& verdicts, const std::string& hash,
                      const OutsideEntry& entry);

    /// True for a file with the content of a file that an edit has read: it must not be replaced.
    /// \throw IoError if it cannot be read
    [[nodiscard]] bool is_source(const std::filesystem::path& file) const;

    /// A file with the content of one that an edit has read is read there from now on if it is no
    /// longer in its old place.
    /// \return is_source(file)
    /// \throw IoError if it cannot be read
    bool find_source_in(const std::filesystem::path& file);

    /// The edits of the current state, by step, then time. Runs nothing.
    [[nodiscard]] std::vector<LogEntry> log() const;

    /// Those that a variant consists of.
    [[nodiscard]] std::vector<LogEntry> log(const std::string& variant) const;

    /// A snapshot of the session, for any thread to hold.
    [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;

    /// Runs each done edit of the current state again on its stored input, with its resolved
    /// arguments, and compares with its stored result bit for bit.
    [[nodiscard]] std::vector<ReplayEntry> replay(Progress progress = {});

    /// Writes the whole project, with its history, to a new file; this session stays with the old
    /// one.
    /// \throw IoError if the file exists or cannot be written
    void save_as(const std::filesystem::path& project, Progress progress = {}) const;

    /// After this, the project's file alone holds all edits; until then, or the session's end, the
    /// last ones are in its write-ahead log.
    /// \throw IoError that says where the edits are if the file cannot be written, or another
    /// process does not end reading it
    void fold_log() const;

    /// Removes the project's file while no other process can open it for writing, for a session
    /// whose edits are of no use. The session can then only be destroyed.
    void discard();

    /// From now on every operation runs in a worker process, not only the `isolated` ones: a cancel
    /// then ends it at once. See WorkerOptions::every_operation.
    void run_in_workers();

private:
    struct Parts;
    explicit Session(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace vesselbench
