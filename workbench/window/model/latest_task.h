#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Answers questions on a thread of its own, one after the other; of those that wait, only the last
/// one is answered. Used by the frame's thread; no call blocks but the destructor, which cancels
/// the work and waits for its end.
template <class Answer>
class LatestTask {
public:
    /// It may throw Cancelled, and nothing else.
    using Work = std::function<Answer(const Progress&)>;

    /// \param wake called by the other thread when take() has something to do
    explicit LatestTask(std::function<void()> wake) : wake_(std::move(wake)) {}

    ~LatestTask() { stop_.request_stop(); }

    LatestTask(const LatestTask&) = delete;
    LatestTask& operator=(const LatestTask&) = delete;

    void begin(Work work) {
        waiting_ = std::move(work);
        if (!running_.valid()) start();
    }

    /// Drops what waits and what runs.
    void forget() {
        waiting_ = nullptr;
        if (!running_.valid()) return;
        stop_.request_stop();
        dropped_ = true;
    }

    /// The answer of the work that has ended, once; the next one starts.
    [[nodiscard]] std::optional<Answer> take() {
        using namespace std::chrono_literals;
        if (!running_.valid() || running_.wait_for(0s) != std::future_status::ready)
            return std::nullopt;
        std::optional<Answer> answer = running_.get();
        if (std::exchange(dropped_, false)) answer.reset();
        if (waiting_) start();
        return answer;
    }

    /// True while an answer is to come.
    [[nodiscard]] bool pending() const { return waiting_ || (running_.valid() && !dropped_); }

private:
    void start() {
        stop_ = {};
        running_ = std::async(std::launch::async,
                              [work = std::exchange(waiting_, nullptr),
                               progress = Progress(nullptr, stop_.get_token()), wake = wake_] {
                                  std::optional<Answer> answer;
                                  try {
                                      answer = work(progress);
                                  } catch (const Cancelled&) {
                                      answer.reset();
                                  }
                                  if (wake) wake();
                                  return answer;
                              });
    }

    std::function<void()> wake_;
    Work waiting_;
    std::stop_source stop_;
    bool dropped_ = false;  ///< the answer of what runs is of no use
    std::future<std::optional<Answer>> running_;
};

}  // namespace vesselbench
