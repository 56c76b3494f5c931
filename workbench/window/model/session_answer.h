#pragma once

#include <optional>
#include <string>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/session/job.h"

namespace vesselbench {

/// A question that the session's thread answers in the background, between the user's requests:
/// work that was cancelled for a request is due again after it. Used by the frame's thread.
template <class Answer>
class SessionAnswer {
public:
    /// The answer is wanted, and not the one before.
    void ask() {
        pause();
        wanted_ = true;
    }

    void forget() {
        pause();
        wanted_ = false;
    }

    /// True if a job should be started for it.
    [[nodiscard]] bool due() const { return wanted_ && !job_; }

    /// True while it is wanted and not known.
    [[nodiscard]] bool pending() const { return wanted_; }

    void start(Job<Answer> job) { job_ = std::move(job); }

    /// Cancels the job; the answer is due again.
    void pause() {
        if (job_) job_->cancel();
        job_.reset();
    }

    /// The answer, once. \throw what the job threw, once; then the answer is not wanted any more
    [[nodiscard]] std::optional<Answer> take() {
        if (!job_ || !job_->ended()) return std::nullopt;
        const Job<Answer> ended = *std::exchange(job_, std::nullopt);
        if (ended.state() == JobState::Cancelled) return std::nullopt;
        wanted_ = false;
        return ended.result();
    }

private:
    bool wanted_ = false;
    std::optional<Job<Answer>> job_;
};

}  // namespace vesselbench
