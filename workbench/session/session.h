#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "workbench/case/edit_record.h"
#include "workbench/case/history.h"
#include "workbench/project/project.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

struct SessionOptions {
    std::string author;                             ///< of the edits; empty: the user's login name
    OperationLookup find;                           ///< required: how operations are found by name
    WorkerOptions worker;                           ///< for isolated operations
    std::size_t embed_limit = kEmbeddedImageBytes;  ///< [bytes] see there
    std::size_t scene_bytes = std::size_t{768}
                              << 20;  ///< scenes held in memory; others are re-read
};

/// How an edit enters the history.
struct EditOptions {
    std::optional<Step> step;     ///< none: the operation's usual step
    std::string variant = "cfd";  ///< for steps 6-8
    std::string author;           ///< empty: the session's
    std::string note;
};

/// One edit of the current state, as the log shows it.
struct LogEntry {
    EditRecord edit;
    EditStatus status = EditStatus::Pending;
    std::string reason;                  ///< of a stale edit
    std::optional<ResultRecord> result;  ///< of a done edit
};

/// What replaying one edit showed.
struct ReplayEntry {
    EditRef edit;
    std::string operation;
    std::string variant;
    bool replayed = false;  ///< false: only the stored result's checksums were tested
    std::vector<std::string> differences;  ///< empty: same bits, or as `distance` says
    std::optional<double> distance;  ///< largest between vertices [mm], of what a GPU computed
    std::string note;                ///< why it was not run again
};

/// A case being worked on: history, project file and running operations in one. Command line,
/// recipes, tests and the window go through this door. Every change is in the project file, by one
/// transaction, before the call returns; a call that throws leaves everything as it was.
class Session {
public:
    /// Makes a new project file. \throw IoError if it exists or cannot be written
    [[nodiscard]] static Session create(const std::filesystem::path& project,
                                        SessionOptions options = {});

    /// Opens a project. If another process has it open for writing, or it cannot be written, this
    /// session only reads; read_only_reason() says why.
    /// \throw IoError if it cannot be read, InvalidInput if it is no project, damaged, or of a
    ///        newer version
    [[nodiscard]] static Session open(const std::filesystem::path& project,
                                      SessionOptions options = {});

    /// A session without a file; save_as() makes one of it.
    [[nodiscard]] static Session unsaved(SessionOptions options = {});

    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;
    ~Session();

    /// Empty if this session may write.
    [[nodiscard]] const std::string& read_only_reason() const;

    /// Runs an operation and enters it into the history. Edits before it that are pending run
    /// first; those behind it become pending.
    /// \throw UsageError on wrong arguments, step or variant; what the operation throws; IoError if
    /// the session only reads or the project cannot be written
    LogEntry apply(const std::string& operation, const Arguments& given,
                   const EditOptions& options = {}, Progress progress = {});

    /// Runs an edit of the current state with other arguments: its next revision. The edits behind
    /// it become pending.
    /// \throw as apply()
    LogEntry change_edit(EditId id, const Arguments& given, const EditOptions& options = {},
                         Progress progress = {});

    /// Leaves an edit out; the edits behind it become pending.
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
    /// session that only reads runs them for itself.
    [[nodiscard]] Scene scene(const std::string& variant = "cfd", Progress progress = {});

    /// The scene right after one edit of the current state; pending edits up to it run first.
    [[nodiscard]] Scene scene_after(EditId id, Progress progress = {});

    /// The edits of the current state, by step, then time. Runs nothing.
    [[nodiscard]] std::vector<LogEntry> log() const;

    /// States, edits and results without their data.
    [[nodiscard]] const History& history() const;

    /// Runs each done edit of the current state anew on its stored input, with its resolved
    /// arguments, and compares with its stored result bit for bit.
    [[nodiscard]] std::vector<ReplayEntry> replay(Progress progress = {});

    /// Writes the whole project, with its history, to a new file; this session stays with the old
    /// one.
    /// \throw IoError if the file exists or cannot be written
    void save_as(const std::filesystem::path& project) const;

private:
    struct Parts;
    explicit Session(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace vesselbench
