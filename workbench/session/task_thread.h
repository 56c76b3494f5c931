#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "workbench/session/task_run.h"

namespace vesselbench {

/// A thread that makes the calls of runs one after the other, in the order in which they were
/// added; it begins with the first one. Accessible from any thread.
class TaskThread {
public:
    enum class WhenIdle {
        Ends,  ///< the next run begins another thread
        Waits  ///< all runs have the same thread
    };

    /// Called by the thread; none may throw.
    struct Hooks {
        std::function<void()> called;   ///< after a call, before its end can be seen
        std::function<void()> ended;    ///< after the end of each run
        std::function<void()> closing;  ///< once no call follows
    };

    explicit TaskThread(WhenIdle when_idle = WhenIdle::Ends, Hooks hooks = {});

    /// Cancels waiting and running runs, and waits for their end.
    ~TaskThread();

    TaskThread(const TaskThread&) = delete;
    TaskThread& operator=(const TaskThread&) = delete;

    /// Without a thread the run ends at once, with AlgorithmFailure.
    void add(const std::shared_ptr<TaskRun>& run);

    void cancel_all();

    /// True if nothing waits and nothing runs.
    [[nodiscard]] bool idle() const;

private:
    [[nodiscard]] std::exception_ptr ensure_thread();
    void work();
    [[nodiscard]] std::shared_ptr<TaskRun> next();
    void make(TaskRun& run);

    const WhenIdle when_idle_;
    const Hooks hooks_;
    mutable std::mutex mutex_;  ///< of what follows
    std::condition_variable added_;
    std::deque<std::shared_ptr<TaskRun>> waiting_;
    std::shared_ptr<TaskRun> running_;
    bool works_ = false;  ///< the thread takes what is added
    bool closing_ = false;
    std::thread thread_;
};

}  // namespace vesselbench
