#pragma once

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// A receiver whose fraction never decreases, whatever the parts of a computation report: a lower
/// value is passed on as the largest one so far. Thread-safe if `receiver` is.
[[nodiscard]] Progress::Receiver monotone(Progress::Receiver receiver);

}  // namespace vesselbench
