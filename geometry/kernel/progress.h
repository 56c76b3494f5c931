#pragma once

#include <functional>
#include <stop_token>
#include <string_view>
#include <utility>

namespace vesselbench {

/// Reports how far a long computation is, and tells it to stop. A copy shares the receiver and the
/// stop token.
class Progress {
public:
    /// \param fraction done so far, in [0, 1]
    using Receiver = std::function<void(double fraction, std::string_view what)>;

    Progress() = default;

    Progress(Receiver receiver, std::stop_token stop)
        : receiver_(std::move(receiver)), stop_(std::move(stop)) {}

    /// Reports `fraction` [0, 1] of this part. \throw Cancelled if the user asked to stop.
    void report(double fraction, std::string_view what) const;

    /// \throw Cancelled if the user asked to stop
    void check_cancelled() const;

    /// The part [from, to] of this progress as a progress of its own from 0 to 1.
    [[nodiscard]] Progress part(double from, double to) const;

    /// One that can be cancelled, but reports nothing: for parts that run at the same time.
    [[nodiscard]] Progress silent() const { return {nullptr, stop_}; }

private:
    Receiver receiver_;
    std::stop_token stop_;
    double from_ = 0.0;
    double to_ = 1.0;
};

}  // namespace vesselbench
