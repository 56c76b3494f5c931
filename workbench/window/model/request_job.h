#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "workbench/session/job.h"

namespace vesselbench {

/// Kinds of requests on a case, by what they may meet while they wait.
enum class RequestKind {
    History,  ///< undo, redo, another state, a note: short, and may wait behind one another
    Edit,     ///< adds or changes edits
    Preview,  ///< superseded by every other request
    Output,   ///< files outside the project
};

/// What a request is for.
struct RequestLabel {
    std::string what;
    RequestKind kind = RequestKind::Edit;
    std::string operation;  ///< empty: none
};

/// How a request that did not succeed ended.
struct RequestEnd {
    RequestLabel label;
    std::string error;  ///< empty: it was cancelled
};

/// A request that waits or runs, with what its end does.
struct RequestJob {
    RequestLabel label;
    std::function<bool()> ended;
    std::function<JobProgress()> progress;
    std::function<void()> cancel;
    std::function<void()> finish;  ///< once, after its end
};

/// \param then called with the result \param otherwise called with the reason, or none if it was
/// cancelled
template <class Result, class Then, class Otherwise>
[[nodiscard]] RequestJob request_job(Job<Result> job, RequestLabel label, Then then,
                                     Otherwise otherwise) {
    RequestJob request{.label = label};
    request.ended = [job] { return job.ended(); };
    request.progress = [job] { return job.progress(); };
    request.cancel = [job] { job.cancel(); };
    request.finish = [job, label = std::move(label), then, otherwise] {
        try {
            then(job.result());
        } catch (const Cancelled&) {
            otherwise(RequestEnd{label, ""});
        } catch (const std::exception& error) {
            otherwise(RequestEnd{label, error.what()});
        }
    };
    return request;
}

/// Removes the requests that have ended, in order; each is asked once: it may end meanwhile.
[[nodiscard]] inline std::vector<RequestJob> take_ended(std::vector<RequestJob>& jobs) {
    const auto runs = [](const RequestJob& job) { return !job.ended(); };
    const auto first = std::stable_partition(jobs.begin(), jobs.end(), runs);
    std::vector<RequestJob> ended(std::make_move_iterator(first),
                                  std::make_move_iterator(jobs.end()));
    jobs.erase(first, jobs.end());
    return ended;
}

}  // namespace vesselbench
