#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

namespace vesselbench {

/// Reports the progress of a long computation, and stops it on request. A copy shares the receiver
/// and the stop token.
class Progress {
public:
    /// \param fraction done so far, in [0, 1]
    using Receiver = std::function<void(double fraction, std::string_view what)>;

    Progress() = default;

    Progress(Receiver receiver, std::stop_token stop)
        : receiver_(std::move(receiver)), stop_(std::move(stop)) {}

    /// Reports `fraction` [0, 1] of this part. \throw Cancelled if the user cancels
    void report(double fraction, std::string_view what) const;

    /// \throw Cancelled if the user cancels
    void check_cancelled() const;

    /// The same for the callbacks of libraries, through which nothing may be thrown.
    [[nodiscard]] bool is_cancelled() const { return stop_.stop_requested(); }

    /// The part [from, to] of this progress as a progress from 0 to 1.
    [[nodiscard]] Progress part(double from, double to) const;

    /// A progress that can be cancelled, but reports nothing: for parts that run in parallel.
    [[nodiscard]] Progress silent() const { return {nullptr, stop_}; }

private:
    Receiver receiver_;
    std::stop_token stop_;
    double from_ = 0.0;
    double to_ = 1.0;
};

/// Progress of a loop whose passes are too short to report each of them.
class LoopProgress {
public:
    /// \param progress of the loop, from 0 to 1
    /// \param passes how often step() will be called
    LoopProgress(Progress progress, std::size_t passes, std::string what)
        : progress_(std::move(progress)), passes_(passes), what_(std::move(what)) {}

    /// To be called in each pass; reports in the first, and then in each 4096th.
    /// \throw Cancelled if the user cancels
    void step() {
        if (done_++ % kInterval == 0) report();
    }

private:
    static constexpr std::size_t kInterval = 4096;  // about a millisecond of writing

    void report() const;

    Progress progress_;
    std::size_t passes_, done_ = 0;
    std::string what_;
};

}  // namespace vesselbench
