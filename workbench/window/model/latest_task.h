#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <new>
#include <optional>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Answers questions on a thread of its own, one after the other; of those that wait, only the last
/// one is answered. Used by the frame's thread; no call throws, and none blocks but the destructor,
/// which cancels the work and waits for its end.
template <class Answer>
class LatestTask {
public:
    /// May throw Cancelled: there is no answer; or anything else: there is a problem.
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
        problem_.clear();
        if (!running_.valid()) return;
        stop_.request_stop();
        dropped_ = true;
    }

    /// The answer of the work that has ended, once; the next one starts. None also if it failed:
    /// take_problem() says why.
    [[nodiscard]] std::optional<Answer> take() {
        using namespace std::chrono_literals;
        if (!running_.valid() || running_.wait_for(0s) != std::future_status::ready)
            return std::nullopt;
        Ended ended = running_.get();
        if (std::exchange(dropped_, false)) ended = {};
        problem_ = std::move(ended.problem);
        if (waiting_) start();
        return std::move(ended.answer);
    }

    /// Why the work that ended last has no answer, once; empty: it has one, or was cancelled.
    [[nodiscard]] std::string take_problem() { return std::exchange(problem_, {}); }

    /// True while an answer is to come.
    [[nodiscard]] bool pending() const { return waiting_ || (running_.valid() && !dropped_); }

private:
    struct Ended {
        std::optional<Answer> answer;
        std::string problem;
    };

    [[nodiscard]] static Ended outcome(const Work& work, const Progress& progress) {
        Ended ended;
        try {
            ended.answer.emplace(work(progress));
        } catch (const Cancelled&) {  // nobody wants to know
        } catch (const std::bad_alloc&) {
            ended.problem = "there is not enough memory";
        } catch (const std::exception& error) {
            ended.problem = error.what();
        } catch (...) {
            ended.problem = "an unknown error";
        }
        return ended;
    }

    void start() {
        stop_ = {};
        try {
            running_ = std::async(std::launch::async,
                                  [work = std::exchange(waiting_, nullptr),
                                   progress = Progress(nullptr, stop_.get_token()), wake = wake_] {
                                      Ended ended = outcome(work, progress);
                                      if (wake) wake();
                                      return ended;
                                  });
        } catch (const std::system_error& error) {
            problem_ = std::string("no thread can be started: ") + error.what();
        }
    }

    std::function<void()> wake_;
    Work waiting_;
    std::stop_source stop_;
    bool dropped_ = false;  ///< the answer of what runs is of no use
    std::string problem_;
    std::future<Ended> running_;
};

}  // namespace vesselbench
