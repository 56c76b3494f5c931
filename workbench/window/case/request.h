#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "workbench/session/task_run.h"

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
    std::vector<Diagnostic> errors;  ///< empty: it was cancelled
};

/// A request that waits or runs, with what its end does.
struct Request {
    RequestLabel label;
    std::shared_ptr<TaskRun> run;
    std::function<void()> finish;  ///< once, after its end
};

/// Removes the requests that have ended, in order; each is asked once: it may end meanwhile.
[[nodiscard]] inline std::vector<Request> take_ended(std::vector<Request>& requests) {
    const auto runs = [](const Request& request) { return !request.run->ended(); };
    const auto first = std::stable_partition(requests.begin(), requests.end(), runs);
    std::vector<Request> ended(std::make_move_iterator(first),
                               std::make_move_iterator(requests.end()));
    requests.erase(first, requests.end());
    return ended;
}

}  // namespace vesselbench
