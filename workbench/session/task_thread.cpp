#include "workbench/session/task_thread.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"

namespace vesselbench {

TaskThread::TaskThread(WhenIdle when_idle, Hooks hooks)
    : when_idle_(when_idle), hooks_(std::move(hooks)) {}

TaskThread::~TaskThread() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    cancel_all();
    added_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void TaskThread::add(const std::shared_ptr<TaskRun>& run) {
    std::vector<std::shared_ptr<TaskRun>> left_out;
    std::exception_ptr error;
    {
        const std::lock_guard lock(mutex_);
        const auto first =
            std::stable_partition(waiting_.begin(), waiting_.end(), [&](auto& older) {
                return !older->ended() && (run->word().empty() || run->word() != older->word());
            });
        left_out.assign(std::make_move_iterator(first), std::make_move_iterator(waiting_.end()));
        waiting_.erase(first, waiting_.end());
        error = ensure_thread();
        if (!error) waiting_.push_back(run);
    }
    for (const auto& older : left_out) {
        older->cancel();
        older->drop();
    }
    added_.notify_one();
    if (error && run->begin()) {
        run->drop();
        run->end(error);
    }
}

/// \return why there is none
std::exception_ptr TaskThread::ensure_thread() {
    if (works_) return nullptr;
    if (thread_.joinable()) thread_.join();  // it has left next() for the last time
    try {
        thread_ = std::thread([this] { work(); });
    } catch (const std::system_error& error) {
        return std::make_exception_ptr(
            AlgorithmFailure(std::string("no thread can be started: ") + error.what()));
    }
    works_ = true;
    return nullptr;
}

void TaskThread::cancel_all() {
    std::vector<std::shared_ptr<TaskRun>> runs;
    {
        const std::lock_guard lock(mutex_);
        if (running_) runs.push_back(running_);
        runs.insert(runs.end(), waiting_.begin(), waiting_.end());
    }
    for (const auto& run : runs) run->cancel();
}

bool TaskThread::idle() const {
    const std::lock_guard lock(mutex_);
    return waiting_.empty() && !running_;
}

void TaskThread::work() {
    while (const std::shared_ptr<TaskRun> run = next()) make(*run);
    if (hooks_.closing) hooks_.closing();
}

/// \return null: the thread ends
std::shared_ptr<TaskRun> TaskThread::next() {
    std::unique_lock lock(mutex_);
    if (when_idle_ == WhenIdle::Waits)
        added_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) {
        works_ = false;
        return nullptr;
    }
    running_ = std::move(waiting_.front());
    waiting_.pop_front();
    if (closing_) running_->cancel();  // it was added while the others were being cancelled
    return running_;
}

void TaskThread::make(TaskRun& run) {
    const bool begun = run.begin();
    std::exception_ptr error;
    if (begun) {
        error = run.call();
        if (hooks_.called) hooks_.called();
    }
    run.drop();  // before the end is seen
    {
        const std::lock_guard lock(mutex_);
        running_.reset();
    }
    if (begun) run.end(std::move(error));
    if (hooks_.ended) hooks_.ended();
}

}  // namespace vesselbench
