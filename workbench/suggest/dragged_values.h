#pragma once

#include "smoothing/quality/sensitivity.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Arguments while a value is dragged: within a searched parameter's range, its nearest value.
/// \param coarse the nearest coarse value
[[nodiscard]] Arguments with_nearest_values(const Operation& operation, Arguments given,
                                            const SearchSpace& space, bool coarse);

/// Makes an analysis of such values one of those that were given.
void set_current_values(SensitivityAnalysis& analysis, const Arguments& given);

}  // namespace vesselbench
