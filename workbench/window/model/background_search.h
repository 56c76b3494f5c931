#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Finds one value on a thread of its own; a newer request replaces an older one. Used by the
/// frame's thread; no call blocks but the destructor, which cancels a search and waits for its end.
template <class Result>
class BackgroundSearch {
public:
    using Work = std::function<Result(const Progress&)>;

    /// \param wake called by the other thread when update() has something to do
    explicit BackgroundSearch(std::function<void()> wake) : wake_(std::move(wake)) {}

    ~BackgroundSearch() { stop_.request_stop(); }

    BackgroundSearch(const BackgroundSearch&) = delete;
    BackgroundSearch& operator=(const BackgroundSearch&) = delete;

    /// Forgets the result and begins a search; one that runs is cancelled.
    void begin(Work work) {
        forget();
        wanted_ = std::move(work);
        if (!next_.valid()) start();
    }

    /// As begin(), but the last result stays until there is a new one. Only while none is pending.
    void renew(Work work) {
        wanted_ = std::move(work);
        start();
    }

    /// Forgets the result and cancels the search.
    void forget() {
        result_.reset();
        problem_.clear();
        wanted_ = nullptr;
        outdated_ = next_.valid();
        if (outdated_) stop_.request_stop();
    }

    /// Takes a result that is ready. \return true if result() or problem() has changed
    bool update() {
        using namespace std::chrono_literals;
        if (!next_.valid() || next_.wait_for(0s) != std::future_status::ready) return false;
        Found found = next_.get();
        if (std::exchange(outdated_, false)) {
            if (wanted_) start();
            return false;
        }
        result_ = std::move(found.result);
        problem_ = std::move(found.problem);
        return true;
    }

    [[nodiscard]] bool pending() const { return next_.valid(); }

    /// Null while it is not known.
    [[nodiscard]] const std::shared_ptr<const Result>& result() const { return result_; }

    /// Why there is no result; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return problem_; }

private:
    struct Found {
        std::shared_ptr<const Result> result;
        std::string problem;
    };

    void start() {
        stop_ = {};
        next_ = std::async(std::launch::async, [work = std::exchange(wanted_, nullptr),
                                                stop = stop_.get_token(), wake = wake_] {
            Found found;
            try {
                found.result = std::make_shared<const Result>(work(Progress(nullptr, stop)));
            } catch (const std::exception& error) {
                found.problem = error.what();
            }
            if (wake) wake();
            return found;
        });
    }

    std::function<void()> wake_;
    std::future<Found> next_;
    std::stop_source stop_;
    Work wanted_;  ///< to be done after `next_`
    bool outdated_ = false;
    std::shared_ptr<const Result> result_;
    std::string problem_;
};

}  // namespace vesselbench
