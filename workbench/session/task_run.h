#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>

#include "geometry/kernel/progress.h"

namespace vesselbench {

enum class TaskState { Waiting, Running, Done, Failed, Cancelled };

/// Progress of a task.
struct TaskProgress {
    double fraction = 0.0;  ///< [0, 1], never decreases
    std::string what;
};

/// Why a call failed, in words for the user; empty: it did not, or was cancelled.
[[nodiscard]] std::string error_text(const std::exception_ptr& error);

/// A call that a TaskThread makes once, shared with who waits for it; accessible from any thread.
class TaskRun : public std::enable_shared_from_this<TaskRun> {
public:
    using Call = std::function<void(const Progress&)>;

    /// \param word not empty: where it is added, waiting runs with the same word are cancelled
    explicit TaskRun(Call call, std::string word = {});

    TaskRun(const TaskRun&) = delete;
    TaskRun& operator=(const TaskRun&) = delete;

    [[nodiscard]] const std::string& word() const { return word_; }

    [[nodiscard]] TaskState state() const;
    [[nodiscard]] bool ended() const;
    [[nodiscard]] TaskProgress progress() const;

    /// As error_text(); empty until it has ended.
    [[nodiscard]] std::string error() const;

    /// If it waits, the call is never made; if it runs, it ends soon with Cancelled, unless it is
    /// past what can be stopped, as an edit that is just being entered: then it completes.
    void cancel();

    void wait() const;
    /// \return false if it has not ended by then
    [[nodiscard]] bool wait_for(std::chrono::milliseconds time) const;

    /// \throw what the call threw; Cancelled if it was cancelled
    void rethrow() const;

    // The thread's side.

    /// Lets time pass unless it is cancelled. \return false if it was cancelled
    [[nodiscard]] bool rests(std::chrono::milliseconds time);

    /// \return false if it was cancelled before
    [[nodiscard]] bool begin();
    /// Makes the call. \return what it threw
    [[nodiscard]] std::exception_ptr call();

    /// Frees what the call holds.
    void drop() { call_ = nullptr; }

    void end(std::exception_ptr error);

private:
    [[nodiscard]] Progress reporter();

    Call call_;  ///< used by one thread at a time: who adds it, then the one that makes it
    const std::string word_;
    std::stop_source stop_;
    mutable std::mutex mutex_;  ///< of what follows
    mutable std::condition_variable_any changed_;
    TaskState state_ = TaskState::Waiting;
    TaskProgress progress_;
    std::exception_ptr error_;
};

}  // namespace vesselbench
