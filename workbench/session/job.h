#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "geometry/kernel/progress.h"

namespace vesselbench {

enum class JobState { Waiting, Running, Done, Failed, Cancelled };

/// Progress of a job.
struct JobProgress {
    double fraction = 0.0;  ///< [0, 1], never decreases
    std::string what;
};

/// State shared by a request's owner and the thread that runs it; accessible from any thread.
class JobCore {
public:
    [[nodiscard]] JobState state() const;
    [[nodiscard]] bool ended() const;
    [[nodiscard]] JobProgress progress() const;

    /// The text of the error; empty unless it failed.
    [[nodiscard]] std::string error() const;

    /// A waiting job is never run; a running one ends soon with Cancelled, unless it is just being
    /// entered into the project: then it completes.
    void cancel();

    void wait() const;
    /// \return false if it has not ended by then
    [[nodiscard]] bool wait_for(std::chrono::milliseconds time) const;

    /// \throw what the job threw; Cancelled if it was cancelled
    void rethrow() const;

    // The thread's side.

    /// \return false if it was cancelled before
    [[nodiscard]] bool begin();
    void end(std::exception_ptr error);
    [[nodiscard]] static Progress reporter(const std::shared_ptr<JobCore>& job);

private:
    mutable std::mutex mutex_;
    mutable std::condition_variable ended_;
    JobState state_ = JobState::Waiting;
    JobProgress progress_;
    std::exception_ptr error_;
    std::stop_source stop_;
};

/// The result of a request that runs in the background: a value that may be copied, polled each
/// frame, waited for, cancelled or dropped, from any thread. Dropping it does not cancel it.
template <class Result>
class Job {
public:
    [[nodiscard]] JobState state() const { return core_->state(); }

    [[nodiscard]] bool ended() const { return core_->ended(); }

    [[nodiscard]] JobProgress progress() const { return core_->progress(); }

    [[nodiscard]] std::string error() const { return core_->error(); }

    void cancel() const { core_->cancel(); }

    void wait() const { core_->wait(); }

    [[nodiscard]] bool wait_for(std::chrono::milliseconds time) const {
        return core_->wait_for(time);
    }

    /// Waits for the end. \throw what the request threw; Cancelled if it was cancelled or
    /// superseded
    [[nodiscard]] const Result& result() const& {
        core_->wait();
        core_->rethrow();
        return **result_;
    }

    /// The same by value: of a temporary job, nothing else may hold the result.
    [[nodiscard]] Result result() const&& {
        const Job& job = *this;
        return job.result();
    }

private:
    friend class SessionRunner;

    std::shared_ptr<JobCore> core_ = std::make_shared<JobCore>();
    std::shared_ptr<std::optional<Result>> result_ = std::make_shared<std::optional<Result>>();
};

/// The result of requests without one.
struct Nothing {};

}  // namespace vesselbench
