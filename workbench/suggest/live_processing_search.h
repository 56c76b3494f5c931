#pragma once

#include <memory>

#include "workbench/case/operation.h"
#include "workbench/suggest/live_search_way.h"

namespace vesselbench {

/// The live search of an operation whose whole runs are compared, such as one that changes
/// triangles (thesis 7.2).
[[nodiscard]] std::unique_ptr<LiveSearchWay> live_processing_search(const Operation& operation,
                                                                    Scene scene);

}  // namespace vesselbench
