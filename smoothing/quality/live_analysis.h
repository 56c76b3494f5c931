#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "smoothing/quality/sensitivity.h"

namespace vesselbench {

/// The current answer to a request.
struct LiveAnswer {
    std::uint64_t request = 0;
    SensitivityAnalysis analysis;    ///< with a suggestion for each parameter
    std::optional<Suggestion> best;  ///< of all parameters together; none in the first answers
    bool complete = false;           ///< no finer answer follows
    std::string error;               ///< why there is no answer; else empty
};

/// Sends answers for a set, coarse ones first: graphs, then finer ones, a first suggestion, and the
/// settled one. What was measured before is not measured again; the complete answer does not depend
/// on it.
/// \param graphs search whose parameters are varied
/// \param best search of the best of all; it may be the same
/// \throw Cancelled
void analyse_step_by_step(ParameterSearch& graphs, ParameterSearch& best,
                          const ParameterSet& current,
                          const std::function<void(const LiveAnswer&)>& send,
                          const Progress& progress);

/// Sensitivity analysis and suggestions in the background while a user changes parameters: a new
/// value stops the analysis in progress at once, and is answered coarsely first, then more finely.
/// Measurements made for earlier values are reused; the complete answer does not depend on them.
class LiveAnalysis {
public:
    /// Called on the analysis thread, answer after answer; must not call back.
    using Receiver = std::function<void(const LiveAnswer&)>;

    LiveAnalysis(ParameterSearch search, Receiver receiver);

    /// Stops the analysis in progress.
    ~LiveAnalysis();
    LiveAnalysis(const LiveAnalysis&) = delete;
    LiveAnalysis& operator=(const LiveAnalysis&) = delete;

    /// Requests the analysis around a set. \return the number its answers carry
    std::uint64_t ask(ParameterSet current, ScoreSettings settings);

    /// Blocks until the last request is answered completely.
    void wait();

private:
    struct Request {
        std::uint64_t number = 0;
        ParameterSet current;
        ScoreSettings settings;
        std::stop_token stop;
    };

    void work(const std::stop_token& end);
    void answer(const Request& request);
    void send(const Request& request, const LiveAnswer& answer);

    ParameterSearch search_;
    Receiver receiver_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<Request> waiting_;
    bool busy_ = false;
    std::stop_source current_;
    std::uint64_t asked_ = 0;
    std::jthread worker_;  ///< last: ends before the members it uses are destroyed
};

}  // namespace vesselbench
