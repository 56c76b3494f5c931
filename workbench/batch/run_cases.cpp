#include "workbench/batch/run_cases.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace vesselbench {

namespace {

/// The cases that are left, taken by several threads.
class Queue {
public:
    Queue(std::vector<PlannedCase>& cases, const BatchOptions& options, const BatchTeller& tell,
          const Progress& progress)
        : options_(options), tell_(tell), progress_(progress) {
        for (PlannedCase& one : cases)
            if (!one.record) left_.push_back(&one);
    }

    void run() {
        {
            std::vector<std::jthread> threads;
            const std::size_t count = std::clamp<std::size_t>(options_.jobs, 1, left_.size() + 1);
            for (std::size_t i = 0; i < count; ++i) threads.emplace_back([this] { work(); });
        }
        if (error_) std::rethrow_exception(error_);
    }

private:
    void work() {
        for (std::size_t i = next_++; i < left_.size() && !stopped_; i = next_++) try {
                run_one(*left_[i]);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!error_) error_ = std::current_exception();
                stopped_ = true;
            }
    }

    void run_one(PlannedCase& one) {
        const BatchTeller tell = [this](const std::string& text) {
            const std::lock_guard lock(mutex_);
            tell_(text);
        };
        one.record = run_case(one, options_, tell, progress_);
        const std::lock_guard lock(mutex_);
        ++done_;
        tell_(std::to_string(done_) + "/" + std::to_string(left_.size()) + " " + one.what.name +
              ": " + outcome_text(*one.record));
    }

    const BatchOptions& options_;
    const BatchTeller& tell_;
    const Progress progress_;
    std::vector<PlannedCase*> left_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;  // of what follows, and of tell_
    std::size_t done_ = 0;
    std::exception_ptr error_;
};

}  // namespace

void run_cases(std::vector<PlannedCase>& cases, const BatchOptions& options,
               const BatchTeller& tell, const Progress& progress) {
    Queue(cases, options, tell, progress.silent()).run();
}

}  // namespace vesselbench
