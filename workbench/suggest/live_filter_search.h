#pragma once

#include <memory>

#include "workbench/case/operation.h"
#include "workbench/suggest/live_search_way.h"

namespace vesselbench {

/// The live search of an operation that smooths: by iterations of its filter.
[[nodiscard]] std::unique_ptr<LiveSearchWay> live_filter_search(const Operation& operation,
                                                                Scene scene);

}  // namespace vesselbench
