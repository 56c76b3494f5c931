#pragma once

#include <memory>

#include "smoothing/quality/smoothing_engine.h"

namespace vesselbench {

/// The engine of smoothing/ and SurfaceMeter. The same bits on any number of threads.
/// \param planes measures error_thesis too
/// \throw InvalidInput if the ground does not fit together
[[nodiscard]] std::shared_ptr<const SmoothingEngine> make_cpu_engine(FilterGround ground,
                                                                     bool planes = false);

}  // namespace vesselbench
