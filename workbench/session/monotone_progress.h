#pragma once

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// A receiver whose fraction never goes back, whatever the parts of a computation report: what is
/// lower than before is passed on as what was reached. Thread-safe if `receiver` is.
[[nodiscard]] Progress::Receiver monotone(Progress::Receiver receiver);

}  // namespace vesselbench
