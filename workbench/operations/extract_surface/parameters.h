#pragma once

#include "geometry/image/extract_surface.h"
#include "workbench/case/arguments.h"

namespace vesselbench {

/// What the arguments of extract-surface ask for.
/// \param with_mask the image has a mask
/// \throw UsageError if arguments contradict each other, or labels are no labels
[[nodiscard]] ExtractionParameters extraction_parameters(const Arguments& arguments,
                                                         bool with_mask);

}  // namespace vesselbench
