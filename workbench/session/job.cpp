#include "workbench/session/job.h"

#include "geometry/kernel/errors.h"
#include "workbench/session/monotone_progress.h"

namespace vesselbench {

namespace {

bool is_end(JobState state) {
    return state != JobState::Waiting && state != JobState::Running;
}

JobState end_state(const std::exception_ptr& error) {
    if (!error) return JobState::Done;
    try {
        std::rethrow_exception(error);
    } catch (const Cancelled&) {
        return JobState::Cancelled;
    } catch (...) {
        return JobState::Failed;
    }
}

}  // namespace

JobState JobCore::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

bool JobCore::ended() const {
    return is_end(state());
}

JobProgress JobCore::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

std::string JobCore::error() const {
    if (state() != JobState::Failed) return {};
    try {
        rethrow();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

void JobCore::cancel() {
    stop_.request_stop();
    const std::lock_guard lock(mutex_);
    if (state_ != JobState::Waiting) return;
    state_ = JobState::Cancelled;
    error_ = std::make_exception_ptr(Cancelled());
    ended_.notify_all();
}

void JobCore::wait() const {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return is_end(state_); });
}

bool JobCore::wait_for(std::chrono::milliseconds time) const {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [&] { return is_end(state_); });
}

void JobCore::rethrow() const {
    std::exception_ptr error;
    {
        const std::lock_guard lock(mutex_);
        error = error_;
    }
    if (error) std::rethrow_exception(error);
}

bool JobCore::begin() {
    const std::lock_guard lock(mutex_);
    if (state_ != JobState::Waiting) return false;
    state_ = JobState::Running;
    return true;
}

void JobCore::end(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    state_ = end_state(error);
    if (state_ == JobState::Done) progress_.fraction = 1.0;
    error_ = std::move(error);
    ended_.notify_all();
}

Progress JobCore::reporter(const std::shared_ptr<JobCore>& job) {
    return {monotone([shared = std::weak_ptr(job)](double fraction, std::string_view what) {
                const auto alive = shared.lock();
                if (!alive) return;
                const std::lock_guard lock(alive->mutex_);
                alive->progress_ = {fraction, std::string(what)};
            }),
            job->stop_.get_token()};
}

}  // namespace vesselbench
