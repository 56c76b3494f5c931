#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "workbench/session/session.h"
#include "workbench/session/task.h"

namespace vesselbench {

/// The background thread that owns a session (DESIGN 1, "Jobs"): requests come from any thread and
/// run one after the other, in order; results are returned as tasks. No call blocks, except those
/// of a task that say so. Operations run in worker processes, so that a cancel ends them at once;
/// live edits run on this thread.
class SessionRunner {
public:
    /// \param notify called by the background thread whenever a request has ended, so that a window
    /// wakes up and polls its tasks; it must not throw
    explicit SessionRunner(Session session, std::function<void()> notify = {});

    /// Cancels waiting and running requests, and waits for their end.
    ~SessionRunner() = default;

    SessionRunner(const SessionRunner&) = delete;
    SessionRunner& operator=(const SessionRunner&) = delete;

    /// A snapshot of the session; it includes every ended request.
    [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;

    /// Empty if the session may write.
    [[nodiscard]] std::string read_only_reason() const { return snapshot()->read_only_reason; }

    /// Runs `call(Session&, Progress) -> Result` on the background thread; the requests below are
    /// built on it.
    /// \param supersede not empty: cancels waiting requests with the same word
    template <class Call>
    auto submit(Call call, std::string supersede = {})
        -> Task<std::invoke_result_t<Call&, Session&, Progress>> {
        return {thread_,
                [this, call = std::move(call)](const Progress& progress) mutable {
                    return call(session_, progress);
                },
                std::move(supersede)};
    }

    // As the session's functions of the same names.

    Task<LogEntry> apply(std::string operation, Arguments given, EditOptions options = {});
    Task<LogEntry> change_edit(EditId id, Arguments given, EditOptions options = {});
    Task<Preview> preview(std::string operation, Arguments given, EditOptions options = {},
                          std::string supersede = "preview");
    Task<Preview> preview_change(EditId id, Arguments given, EditOptions options = {},
                                 std::string supersede = "preview");
    Task<LogEntry> commit(Preview preview);
    Task<Nothing> remove_edit(EditId id);
    Task<Nothing> undo();
    Task<Nothing> undo(EditId before);
    Task<Nothing> redo();
    Task<Nothing> redo(EditId to);
    Task<Nothing> jump(StateId state);
    Task<Scene> scene(std::string variant = kDefaultVariant);
    Task<Scene> scene_after(EditId id);
    Task<Scene> result_scene(ResultId id);
    Task<std::vector<ReplayEntry>> replay();
    Task<Nothing> save_as(std::filesystem::path project);

    /// Runs a callback on the scene of a variant: an export, a measure.
    Task<Nothing> with_scene(std::string variant,
                             std::function<void(const Scene&, const Progress&)> call);

    // A live edit: started, extended, shown, entered. Only requests access the pointed-to object.

    using Live = std::shared_ptr<LiveEdit>;
    Task<Live> start_live(std::string operation, Arguments given, EditOptions options = {});
    /// \param supersede not empty for operations whose arguments are replaced: waiting ones are
    /// skipped. A brush's dabs add up: none may be skipped
    /// \return the scene after it
    Task<Scene> add(Live live, Arguments more, std::string supersede = {});
    Task<LogEntry> commit(Live live);

    /// Cancels waiting and running requests.
    void cancel_all() { thread_.cancel_all(); }

    /// True if nothing waits and nothing runs.
    [[nodiscard]] bool idle() const { return thread_.idle(); }

private:
    void publish();

    Session session_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Snapshot> snapshot_;  ///< under the mutex
    TaskThread thread_;                         ///< last: it uses all of the above
};

}  // namespace vesselbench
