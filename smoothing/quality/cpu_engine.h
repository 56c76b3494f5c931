#pragma once

#include <memory>

#include "smoothing/quality/smoothing_engine.h"

namespace vesselbench {

/// The engine of smoothing/ and SurfaceMeter. Bit-identical for any number of threads.
/// \param planes measures error_thesis too
/// \throw InvalidInput if the ground is inconsistent
[[nodiscard]] std::shared_ptr<const SmoothingEngine> make_cpu_engine(FilterGround ground,
                                                                     bool planes = false);

}  // namespace vesselbench
