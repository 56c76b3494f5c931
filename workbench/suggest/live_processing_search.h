#pragma once

#include <memory>

#include "workbench/suggest/live_search.h"

namespace vesselbench {

/// The live search of an operation whose whole runs are compared, such as one that changes
/// triangles (thesis 7.2).
[[nodiscard]] std::unique_ptr<LiveSearch::Way> live_processing_search(const Operation& operation,
                                                                      Scene scene);

}  // namespace vesselbench
