#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Answers questions on one thread of its own, step by step, and keeps there what serves several of
/// them: an OpenGL context, or what was found for the question before. A newer question ends the
/// work on an older one at once, and no answer to that follows. The thread begins with the first
/// question. Used by the frame's thread; no call blocks but the destructor. (LatestTask suits
/// questions that have nothing in common.)
template <class Question, class Answer>
class LatestWorker {
public:
    /// What the work on one question needs.
    struct Turn {
        std::uint64_t number = 0;  ///< of the question
        Progress progress;         ///< cancelled by a newer one
        std::function<void(Answer)> send;
        /// Waits whether a newer question comes. \return true if none does
        std::function<bool(std::chrono::milliseconds)> rests;
    };

    /// Made, used and destroyed on the thread.
    class Work {
    public:
        Work() = default;
        virtual ~Work() = default;
        Work(const Work&) = delete;
        Work& operator=(const Work&) = delete;

        /// May throw: Cancelled, or why there is no answer.
        virtual void answer(const Question& question, const Turn& turn) = 0;

        /// Drops what is kept for other questions.
        virtual void forget() = 0;
    };

    using Maker = std::function<std::unique_ptr<Work>()>;

    /// \param wake called by the other thread when update() has something to do
    LatestWorker(std::function<void()> wake, Maker make)
        : wake_(std::move(wake)), make_(std::move(make)) {}

    ~LatestWorker() {
        const std::lock_guard lock(mutex_);
        waiting_.reset();
        current_.request_stop();
        thread_.request_stop();
    }

    LatestWorker(const LatestWorker&) = delete;
    LatestWorker& operator=(const LatestWorker&) = delete;

    /// \return the number of the question
    std::uint64_t ask(Question question) {
        const std::lock_guard lock(mutex_);
        replace(std::move(question));
        if (!thread_.joinable())
            thread_ = std::jthread([this](const std::stop_token& end) { run(end); });
        return asked_;
    }

    /// Ends the work on the last question; what was answered stays.
    void interrupt() {
        const std::lock_guard lock(mutex_);
        current_.request_stop();
        waiting_.reset();
    }

    /// Drops the question, its answers, and what is kept for others.
    void forget() {
        newest_.reset();
        problem_.clear();
        const std::lock_guard lock(mutex_);
        answered_.reset();
        failed_.reset();
        waiting_.reset();
        current_.request_stop();
        if (thread_.joinable()) replace(std::nullopt);
    }

    /// Takes the newest answer. \return true if newest() or problem() has changed
    bool update() {
        const std::lock_guard lock(mutex_);
        if (!answered_ && !failed_) return false;
        problem_.clear();
        if (answered_) newest_ = std::exchange(answered_, nullptr);
        if (failed_) problem_ = *std::exchange(failed_, std::nullopt);
        return true;
    }

    /// The newest answer, also to an earlier question; null: none since forget().
    [[nodiscard]] const std::shared_ptr<const Answer>& newest() const { return newest_; }

    /// Why there is no answer to the last question; empty: there is one, or will be.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// True while a further answer to the last question is to come, or to be taken.
    [[nodiscard]] bool pending() const {
        const std::lock_guard lock(mutex_);
        return busy_ || waiting_ || answered_ || failed_;
    }

private:
    struct Waiting {
        std::uint64_t number = 0;
        std::optional<Question> question;  ///< none: forget
        std::stop_token stop;
    };

    void replace(std::optional<Question> question) {
        current_.request_stop();
        current_ = std::stop_source();
        waiting_.emplace(Waiting{++asked_, std::move(question), current_.get_token()});
        changed_.notify_all();
    }

    void run(const std::stop_token& end) {
        std::unique_ptr<Work> work;
        std::unique_lock lock(mutex_);
        while (changed_.wait(lock, end, [&] { return waiting_.has_value(); })) {
            const Waiting waiting = *std::exchange(waiting_, std::nullopt);
            busy_ = waiting.question.has_value();
            lock.unlock();
            take_turn(waiting, work);
            lock.lock();
            busy_ = false;
            lock.unlock();
            wake();
            lock.lock();
        }
    }

    void take_turn(const Waiting& waiting, std::unique_ptr<Work>& work) {
        std::string problem;
        try {
            if (!work) work = make_();
            if (!waiting.question) return work->forget();
            return work->answer(*waiting.question, turn_of(waiting));
        } catch (const Cancelled&) {
            return;
        } catch (const std::bad_alloc&) {
            problem = "there is not enough memory";
        } catch (const std::exception& error) {
            problem = error.what();
        } catch (...) {
            problem = "an unknown error";
        }
        const std::lock_guard lock(mutex_);
        if (!waiting.stop.stop_requested()) failed_ = problem;
    }

    [[nodiscard]] Turn turn_of(const Waiting& waiting) {
        return {
            .number = waiting.number,
            .progress = Progress(nullptr, waiting.stop),
            .send = [this, stop = waiting.stop](Answer answer) { send(std::move(answer), stop); },
            .rests = [this, stop = waiting.stop](
                         std::chrono::milliseconds time) { return rests(time, stop); }};
    }

    void send(Answer answer, const std::stop_token& stop) {
        auto shared = std::make_shared<const Answer>(std::move(answer));
        {
            const std::lock_guard lock(mutex_);
            if (stop.stop_requested()) return;
            answered_ = std::move(shared);
        }
        wake();
    }

    [[nodiscard]] bool rests(std::chrono::milliseconds time, const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, stop, time, [&] { return waiting_.has_value(); });
        return !stop.stop_requested();
    }

    void wake() const {
        if (wake_) wake_();
    }

    std::function<void()> wake_;
    Maker make_;
    std::shared_ptr<const Answer> newest_;
    std::string problem_;

    mutable std::mutex mutex_;  ///< of what follows
    std::condition_variable_any changed_;
    std::optional<Waiting> waiting_;
    std::stop_source current_;
    std::uint64_t asked_ = 0;
    std::shared_ptr<const Answer> answered_;
    std::optional<std::string> failed_;
    bool busy_ = false;
    std::jthread thread_;  ///< last: ends before the members it uses are destroyed
};

}  // namespace vesselbench
