#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "workbench/session/task_thread.h"

namespace vesselbench {

/// The result of work without one, and what a thread keeps that keeps nothing.
struct Nothing {};

/// A run that has results: one, or one after the other, of which only the newest counts.
template <class Result>
class ResultRun : public TaskRun {
public:
    using Work = std::function<void(ResultRun&, const Progress&)>;

    explicit ResultRun(Work work, std::string word = {})
        : TaskRun(
              [this, work = std::move(work)](const Progress& progress) { work(*this, progress); },
              std::move(word)) {}

    void send(Result result) {
        auto sent = std::make_shared<Result>(std::move(result));
        const std::lock_guard lock(mutex_);
        sent_.swap(sent);
    }

    /// Null while there is none.
    [[nodiscard]] std::shared_ptr<const Result> newest() const {
        const std::lock_guard lock(mutex_);
        return sent_;
    }

    /// As newest(), once.
    [[nodiscard]] std::shared_ptr<Result> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(sent_, nullptr);
    }

private:
    mutable std::mutex mutex_;
    std::shared_ptr<Result> sent_;
};

/// For work that sends several results.
template <class Result>
class TaskTurn {
public:
    TaskTurn(std::uint64_t of_work, const Progress& reporter, ResultRun<Result>& run,
             const std::function<void()>& wake)
        : number(of_work), progress(reporter), run_(run), wake_(wake) {}

    const std::uint64_t number;  ///< that Task::start returned
    const Progress& progress;

    void send(Result result) const {
        run_.send(std::move(result));
        if (wake_) wake_();
    }

    /// Waits whether newer work comes. \return true if none does
    [[nodiscard]] bool rests(std::chrono::milliseconds time) const { return run_.rests(time); }

private:
    ResultRun<Result>& run_;
    const std::function<void()>& wake_;
};

/// Work in the background. A task has a thread of its own and is given work again and again, of
/// which the newest counts: its owner polls it once a frame. Or it is one request of a thread that
/// others share (SessionRunner): then it may be copied, waited for and cancelled from any thread,
/// and the request goes on without it. No call but wait(), wait_for(), result() and the destructor
/// blocks, and only result() throws.
///
/// Work is called as `Result(const Progress&)`, or to send results as `void(const
/// TaskTurn<Result>&)` or `void(Kept&, const TaskTurn<Result>&)`. It may throw Cancelled: there is
/// no result; or anything else: there is a problem.
/// \tparam Kept what its thread keeps from one work to the next, as an OpenGL context: made by the
/// first that uses it, and destroyed on that thread. Its `forget()`, if any, drops what serves only
/// the work before
template <class Result, class Kept = Nothing>
class Task {
public:
    using Turn = TaskTurn<Result>;
    using Maker = std::function<std::unique_ptr<Kept>()>;

    /// For a task to be assigned.
    Task() = default;

    /// A task with a thread of its own, which begins with the first work. The destructor cancels
    /// the work and waits for its end.
    /// \param wake called by the thread when poll() has something to do; it must not throw
    explicit Task(
        std::function<void()> wake, Maker make = [] { return std::make_unique<Kept>(); })
        : wake_(std::move(wake)), keeper_(std::make_shared<Keeper>(Keeper{std::move(make), {}})) {
        constexpr auto when_idle = std::is_same_v<Kept, Nothing> ? TaskThread::WhenIdle::Ends
                                                                 : TaskThread::WhenIdle::Waits;
        thread_ = std::make_shared<TaskThread>(
            when_idle, TaskThread::Hooks{.called = {},
                                         .ended = wake_,
                                         .closing = [keeper = keeper_] { keeper->kept.reset(); }});
    }

    /// A request. \param word as TaskRun's
    Task(TaskThread& thread, std::function<Result(const Progress&)> work, std::string word)
        : run_(std::make_shared<Run>(
              [work = std::move(work)](Run& run, const Progress& progress) {
                  run.send(work(progress));
              },
              std::move(word))) {
        thread.add(run_);
    }

    // --- work of its own thread

    /// Begins work: the newest wins. What runs is cancelled, and nothing it finds from now on is
    /// reported. \return the number of the work
    template <class Work>
    std::uint64_t start(Work work) {
        drop();
        run_ = run_of(std::move(work));
        thread_->add(run_);
        return number_;
    }

    /// Begins work after that which runs, whose result is still reported, instead of that which
    /// waits.
    template <class Work>
    void start_after(Work work) {
        if (next_) next_->cancel();
        std::shared_ptr<Run>& place = run_ ? next_ : run_;
        place = run_of(std::move(work));
        thread_->add(place);
    }

    /// Cancels the work, of which nothing more is reported. What was found so far stays.
    void drop() {
        collect();
        cancel();
        run_.reset();
        next_.reset();
    }

    /// As drop(), and drops what was found and what serves only the work before.
    void forget() {
        drop();
        newest_.reset();
        problem_.clear();
        changed_ = false;
        if constexpr (requires(Kept & kept) { kept.forget(); }) {
            if (number_ == 0) return;  // the thread has not begun
            thread_->add(std::make_shared<TaskRun>(
                [keeper = keeper_](const Progress&) {
                    if (keeper->kept) keeper->kept->forget();
                },
                "forget"));
        }
    }

    /// Takes what was found since the last call, once a frame. \return true if newest() or
    /// problem() has changed
    bool poll() {
        if (run_) {
            const bool ended = run_->ended();  // asked first: nothing is found after it
            collect();
            if (ended) next();
        }
        return std::exchange(changed_, false);
    }

    /// The newest result that was polled, also of earlier work; null: none since forget().
    [[nodiscard]] const std::shared_ptr<const Result>& newest() const { return newest_; }

    /// Moves the newest result out, for owners that hold no other newest(). \return none if there
    /// is none
    [[nodiscard]] std::optional<Result> take() {
        if (!newest_) return std::nullopt;
        // It was made as one that can change.
        return std::move(*std::const_pointer_cast<Result>(std::exchange(newest_, nullptr)));
    }

    /// Why the last work that was polled has no result; empty: it has one, or was cancelled.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// True while something is to come, or to be polled.
    [[nodiscard]] bool pending() const { return run_ || next_ || changed_; }

    // --- the work, or request, that runs or ended last; from any thread for a request

    [[nodiscard]] TaskState state() const { return run_->state(); }

    [[nodiscard]] bool ended() const { return !run_ || run_->ended(); }

    [[nodiscard]] TaskProgress progress() const { return run_ ? run_->progress() : TaskProgress{}; }

    /// As TaskRun::error().
    [[nodiscard]] std::string error() const { return run_ ? run_->error() : ""; }

    /// As TaskRun::cancel(). Its end is still to be polled.
    void cancel() const {
        if (run_) run_->cancel();
        if (next_) next_->cancel();
    }

    /// Until all that was begun has ended.
    void wait() const {
        if (run_) run_->wait();
        if (next_) next_->wait();
    }

    [[nodiscard]] bool wait_for(std::chrono::milliseconds time) const {
        return !run_ || run_->wait_for(time);
    }

    /// Waits for the end of a request. \throw what it threw; Cancelled if it was cancelled or
    /// superseded
    [[nodiscard]] const Result& result() const& {
        run_->wait();
        run_->rethrow();
        return *run_->newest();  // the run holds it
    }

    /// The same by value: of a temporary task, nothing else may hold the result.
    [[nodiscard]] Result result() const&& {
        const Task& task = *this;
        return task.result();
    }

    /// What can be asked without knowing the result's type.
    [[nodiscard]] std::shared_ptr<TaskRun> run() const { return run_; }

private:
    using Run = ResultRun<Result>;

    /// Used by the thread only.
    struct Keeper {
        Maker make;
        std::unique_ptr<Kept> kept;

        Kept& get() {
            if (!kept) kept = make();
            return *kept;
        }
    };

    template <class Work>
    [[nodiscard]] std::shared_ptr<Run> run_of(Work work) {
        return std::make_shared<Run>([work = std::move(work), number = ++number_, keeper = keeper_,
                                      wake = wake_](Run& run, const Progress& progress) mutable {
            [[maybe_unused]] const Turn turn(number, progress, run, wake);
            if constexpr (std::is_invocable_v<Work&, Kept&, const Turn&>)
                work(keeper->get(), turn);
            else if constexpr (std::is_invocable_v<Work&, const Turn&>)
                work(turn);
            else
                run.send(work(progress));
        });
    }

    void collect() {
        if (!run_) return;
        auto found = run_->take();
        if (!found) return;
        newest_ = std::move(found);
        problem_.clear();
        changed_ = true;
    }

    /// After the end of the work that ran.
    void next() {
        problem_ = run_->error();
        if (!problem_.empty()) changed_ = true;
        run_ = std::exchange(next_, nullptr);
        if (run_ && run_->ended() && wake_) wake_();  // it is polled in another frame
    }

    std::function<void()> wake_;
    std::shared_ptr<Keeper> keeper_;
    std::shared_ptr<Run> run_, next_;
    std::shared_ptr<const Result> newest_;
    std::string problem_;
    bool changed_ = false;
    std::uint64_t number_ = 0;            ///< of the last work
    std::shared_ptr<TaskThread> thread_;  ///< null: of a request
};

}  // namespace vesselbench
