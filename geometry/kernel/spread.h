#pragma once

#include <algorithm>
#include <cstddef>

namespace vesselbench {

/// Smallest, mean and largest of a set; zeros if the set is empty.
struct Spread {
    double min = 0.0;
    double mean = 0.0;
    double max = 0.0;
};

/// Collects the spread of values that arrive one by one.
class SpreadBuilder {
public:
    void add(double value) {
        spread_.min = count_ == 0 ? value : std::min(spread_.min, value);
        spread_.max = count_ == 0 ? value : std::max(spread_.max, value);
        sum_ += value;
        ++count_;
    }

    [[nodiscard]] Spread result() const {
        Spread spread = spread_;
        if (count_ > 0) spread.mean = sum_ / static_cast<double>(count_);
        return spread;
    }

private:
    Spread spread_;
    double sum_ = 0.0;
    std::size_t count_ = 0;
};

}  // namespace vesselbench
