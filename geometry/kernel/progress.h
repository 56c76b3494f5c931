#pragma once

#include <functional>
#include <stop_token>
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

}  // namespace vesselbench
