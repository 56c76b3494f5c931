#pragma once

#include <memory>

#include "workbench/suggest/live_search.h"

namespace vesselbench {

/// The live search of an operation that smooths: by iterations of its filter.
[[nodiscard]] std::unique_ptr<LiveSearch::Way> live_filter_search(const Operation& operation,
                                                                  Scene scene);

}  // namespace vesselbench
