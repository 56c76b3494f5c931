#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "workbench/session/job.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// The background thread that owns a session (DESIGN 1, "Jobs"): requests come from any thread and
/// run one after the other, in order; results are returned as jobs. No call blocks, except those of
/// a job that say so. Operations run in worker processes, so that a cancel ends them at once; live
/// edits run on this thread.
class SessionRunner {
public:
    /// \param notify called by the background thread whenever a job has ended, so that a window
    /// wakes up and polls its jobs; it must not throw
    explicit SessionRunner(Session session, std::function<void()> notify = {});

    /// Cancels waiting and running requests, and waits for their end.
    ~SessionRunner();

    SessionRunner(const SessionRunner&) = delete;
    SessionRunner& operator=(const SessionRunner&) = delete;

    /// A snapshot of the session; it includes every ended job.
    [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;

    /// Empty if the session may write.
    [[nodiscard]] std::string read_only_reason() const { return snapshot()->read_only_reason; }

    /// Runs `call(Session&, Progress) -> Result` on the background thread; the requests below are
    /// built on it.
    /// \param supersede not empty: cancels waiting requests with the same word
    template <class Call>
    auto submit(Call call, std::string supersede = {})
        -> Job<std::invoke_result_t<Call&, Session&, Progress>> {
        Job<std::invoke_result_t<Call&, Session&, Progress>> job;
        add({job.core_,
             [call = std::move(call), result = job.result_](Session& session,
                                                            const Progress& progress) mutable {
                 result->emplace(call(session, progress));
             },
             std::move(supersede)});
        return job;
    }

    // As the session's functions of the same names.

    Job<LogEntry> apply(std::string operation, Arguments given, EditOptions options = {});
    Job<LogEntry> change_edit(EditId id, Arguments given, EditOptions options = {});
    Job<Preview> preview(std::string operation, Arguments given, EditOptions options = {},
                         std::string supersede = "preview");
    Job<Preview> preview_change(EditId id, Arguments given, EditOptions options = {},
                                std::string supersede = "preview");
    Job<LogEntry> commit(Preview preview);
    Job<Nothing> remove_edit(EditId id);
    Job<Nothing> undo();
    Job<Nothing> undo(EditId before);
    Job<Nothing> redo();
    Job<Nothing> redo(EditId to);
    Job<Nothing> jump(StateId state);
    Job<Scene> scene(std::string variant = kDefaultVariant);
    Job<Scene> scene_after(EditId id);
    Job<std::vector<ReplayEntry>> replay();
    Job<Nothing> save_as(std::filesystem::path project);

    /// Runs a callback on the scene of a variant: an export, a measure.
    Job<Nothing> with_scene(std::string variant,
                            std::function<void(const Scene&, const Progress&)> call);

    // A live edit: started, extended, shown, entered. Only requests access the pointed-to object.

    using Live = std::shared_ptr<LiveEdit>;
    Job<Live> start_live(std::string operation, Arguments given, EditOptions options = {});
    /// \param supersede not empty for operations whose arguments are replaced: waiting ones are
    /// skipped. A brush's dabs add up: none may be skipped
    /// \return the scene after it
    Job<Scene> add(Live live, Arguments more, std::string supersede = {});
    Job<LogEntry> commit(Live live);

    /// Cancels waiting and running requests.
    void cancel_all();

    /// True if nothing waits and nothing runs.
    [[nodiscard]] bool idle() const;

private:
    struct Request {
        std::shared_ptr<JobCore> core;
        std::function<void(Session&, const Progress&)> call;
        std::string supersede;
    };

    void add(Request request);
    void work();
    void run(Request request);
    void publish();

    Session session_;
    std::function<void()> notify_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Request> waiting_;
    std::shared_ptr<JobCore> running_;
    std::shared_ptr<const Snapshot> snapshot_;
    bool closing_ = false;
    std::thread thread_;  ///< last: it uses all of the above
};

}  // namespace vesselbench
