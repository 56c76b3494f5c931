#pragma once

#include <set>
#include <stop_token>
#include <string>

#include "geometry/kernel/progress.h"

namespace vesselbench::test {

/// A progress that is cancelled as soon as a fraction is reported, and keeps what it heard. It must
/// outlive its progress.
class StopAt {
public:
    /// \param fraction in [0, 1]; above 1: never
    explicit StopAt(double fraction) : fraction_(fraction) {}

    [[nodiscard]] Progress progress() {
        return {[this](double fraction, std::string_view what) {
                    fractions_.insert(fraction);
                    whats_.emplace(what);
                    if (fraction >= fraction_) stop_.request_stop();
                },
                stop_.get_token()};
    }

    [[nodiscard]] const std::set<double>& fractions() const { return fractions_; }

    [[nodiscard]] const std::set<std::string>& whats() const { return whats_; }

private:
    double fraction_;
    std::stop_source stop_;
    std::set<double> fractions_;
    std::set<std::string> whats_;
};

}  // namespace vesselbench::test
