#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "workbench/window/model/latest_task.h"

namespace vesselbench {

/// Finds one value on a thread of its own and keeps it; a newer request replaces an older one. Used
/// by the frame's thread; no call blocks but the destructor, which cancels a search and waits for
/// its end.
template <class Result>
class BackgroundSearch {
public:
    using Work = std::function<Result(const Progress&)>;

    /// \param wake called by the other thread when update() has something to do
    explicit BackgroundSearch(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Forgets the result and begins a search; one that runs is cancelled.
    void begin(Work work) {
        forget();
        renew(std::move(work));
    }

    /// As begin(), but the last result stays until there is a new one.
    void renew(Work work) {
        task_.begin([work = std::move(work)](const Progress& progress) {
            return std::make_shared<const Result>(work(progress));
        });
    }

    /// Forgets the result and cancels the search.
    void forget() {
        result_.reset();
        problem_.clear();
        task_.forget();
    }

    /// Takes a result that is ready. \return true if result() or problem() has changed
    bool update() {
        auto result = task_.take();
        std::string problem = task_.take_problem();
        if (!result && problem.empty()) return false;
        result_ = result ? std::move(*result) : nullptr;
        problem_ = std::move(problem);
        return true;
    }

    [[nodiscard]] bool pending() const { return task_.pending(); }

    /// Null while it is not known.
    [[nodiscard]] const std::shared_ptr<const Result>& result() const { return result_; }

    /// Why there is no result; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return problem_; }

private:
    LatestTask<std::shared_ptr<const Result>> task_;
    std::shared_ptr<const Result> result_;
    std::string problem_;
};

}  // namespace vesselbench
