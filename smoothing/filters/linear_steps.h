#pragma once

#include <vector>

#include "smoothing/filters/linear_parameters.h"
#include "smoothing/filters/linear_step.h"

namespace vesselbench {

/// One iteration of a filter as linear steps, independent of the device.
/// \throw InvalidInput if a parameter is out of its range
[[nodiscard]] std::vector<LinearStep> linear_steps(const LaplaceParameters& parameters);
[[nodiscard]] std::vector<LinearStep> linear_steps(const LaplaceHcParameters& parameters);
[[nodiscard]] std::vector<LinearStep> linear_steps(const TaubinParameters& parameters);

}  // namespace vesselbench
