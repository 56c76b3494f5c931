#include "workbench/session/task_run.h"

#include <new>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/session/monotone_progress.h"

namespace vesselbench {

namespace {

bool is_end(TaskState state) {
    return state != TaskState::Waiting && state != TaskState::Running;
}

TaskState end_state(const std::exception_ptr& error) {
    if (!error) return TaskState::Done;
    try {
        std::rethrow_exception(error);
    } catch (const Cancelled&) {
        return TaskState::Cancelled;
    } catch (...) {
        return TaskState::Failed;
    }
}

}  // namespace

std::string error_text(const std::exception_ptr& error) {
    if (!error) return {};
    try {
        std::rethrow_exception(error);
    } catch (const Cancelled&) {
        return {};
    } catch (const std::bad_alloc&) {
        return "there is not enough memory";
    } catch (const std::exception& known) {
        return known.what();
    } catch (...) {
        return "an unknown error";
    }
}

TaskRun::TaskRun(Call call, std::string word) : call_(std::move(call)), word_(std::move(word)) {}

TaskState TaskRun::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

bool TaskRun::ended() const {
    return is_end(state());
}

TaskProgress TaskRun::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

std::string TaskRun::error() const {
    std::exception_ptr error;
    {
        const std::lock_guard lock(mutex_);
        error = error_;
    }
    return error_text(error);
}

void TaskRun::cancel() {
    stop_.request_stop();
    const std::lock_guard lock(mutex_);
    if (state_ != TaskState::Waiting) return;
    state_ = TaskState::Cancelled;
    error_ = std::make_exception_ptr(Cancelled());
    changed_.notify_all();
}

void TaskRun::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_end(state_); });
}

bool TaskRun::wait_for(std::chrono::milliseconds time) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [&] { return is_end(state_); });
}

void TaskRun::rethrow() const {
    std::exception_ptr error;
    {
        const std::lock_guard lock(mutex_);
        error = error_;
    }
    if (error) std::rethrow_exception(error);
}

bool TaskRun::rests(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    const std::stop_token stop = stop_.get_token();
    changed_.wait_for(lock, stop, time, [] { return false; });
    return !stop.stop_requested();
}

bool TaskRun::begin() {
    const std::lock_guard lock(mutex_);
    if (state_ != TaskState::Waiting) return false;
    state_ = TaskState::Running;
    return true;
}

std::exception_ptr TaskRun::call() {
    try {
        call_(reporter());
    } catch (...) {
        return std::current_exception();
    }
    return nullptr;
}

void TaskRun::end(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    state_ = end_state(error);
    if (state_ == TaskState::Done) progress_.fraction = 1.0;
    error_ = std::move(error);
    changed_.notify_all();
}

Progress TaskRun::reporter() {
    return {monotone([shared = weak_from_this()](double fraction, std::string_view what) {
                const auto alive = shared.lock();
                if (!alive) return;
                const std::lock_guard lock(alive->mutex_);
                alive->progress_ = {fraction, std::string(what)};
            }),
            stop_.get_token()};
}

}  // namespace vesselbench
