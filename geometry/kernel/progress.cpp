#include "geometry/kernel/progress.h"

#include <algorithm>

#include "geometry/kernel/errors.h"

namespace vesselbench {

void Progress::report(double fraction, std::string_view what) const {
    check_cancelled();
    if (receiver_) receiver_(from_ + (to_ - from_) * fraction, what);
}

void Progress::check_cancelled() const {
    if (is_cancelled()) throw Cancelled();
}

Progress Progress::part(double from, double to) const {
    Progress inner = *this;
    inner.from_ = from_ + (to_ - from_) * from;
    inner.to_ = from_ + (to_ - from_) * to;
    return inner;
}

void LoopProgress::report() const {
    const auto passes = static_cast<double>(std::max(passes_, done_));
    progress_.report(static_cast<double>(done_ - 1) / passes, what_);
}

}  // namespace vesselbench
