#pragma once

#include <vector>

#include "geometry/image/extract_surface.h"
#include "workbench/case/arguments.h"

namespace vesselbench {

/// What the arguments of extract-surface ask for.
/// \param with_mask the image has a mask
/// \param vessel labels that are taken unless the arguments name others; empty: all
/// \throw UsageError if arguments contradict each other, or labels are no labels
[[nodiscard]] ExtractionParameters extraction_parameters(const Arguments& arguments, bool with_mask,
                                                         const std::vector<int>& vessel = {});

}  // namespace vesselbench
