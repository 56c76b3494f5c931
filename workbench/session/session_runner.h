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

/// The background thread that owns a session (DESIGN 1, "Jobs"): requests go in from any thread and
/// run one after the other, in their order; results come back as jobs. No call blocks, but those of
/// a job that say so. Operations run in worker processes, so that a cancel ends them at once; live
/// edits run on this thread.
class SessionRunner {
public:
    /// \param notify called by the background thread whenever a job has ended, so that a window
    /// wakes up and asks its jobs; it must not throw
    explicit SessionRunner(Session session, std::function<void()> notify = {});

    /// Cancels what waits and what runs, and waits for the end of it.
    ~SessionRunner();

    SessionRunner(const SessionRunner&) = delete;
    SessionRunner& operator=(const SessionRunner&) = delete;

    /// What the session is now; a job that has ended shows in it.
    [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;

    /// Runs `call(Session&, Progress) -> Result` on the background thread; the ordinary requests
    /// below are made of it.
    /// \param supersede not empty: cancels the requests of the same word that still wait
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
    Job<LogEntry> commit(Preview preview);
    Job<Nothing> remove_edit(EditId id);
    Job<Nothing> undo();
    Job<Nothing> redo();
    Job<Nothing> jump(StateId state);
    Job<Scene> scene(std::string variant = "cfd");
    Job<std::vector<ReplayEntry>> replay();
    Job<Nothing> save_as(std::filesystem::path project);

    /// Runs a callback on the scene of a variant: an export, a measure.
    Job<Nothing> with_scene(std::string variant,
                            std::function<void(const Scene&, const Progress&)> call);

    // A live edit: started, added to, shown, entered. Only requests touch what the pointer holds.

    using Live = std::shared_ptr<LiveEdit>;
    Job<Live> start_live(std::string operation, Arguments given, EditOptions options = {});
    /// \param supersede not empty for operations whose arguments are replaced: those that still
    /// wait are skipped. A brush's dabs add up: none of them may be left out \return the scene
    /// after it
    Job<Scene> add(Live live, Arguments more, std::string supersede = {});
    Job<LogEntry> commit(Live live);

    /// Cancels what waits and what runs.
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
