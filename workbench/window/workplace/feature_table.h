#pragma once

#include "workbench/window/core/core.h"
#include "workbench/window/features/live/live_model.h"

namespace vesselbench {

/// Adds all features of the window, in the order of their updates: a row each.
/// \param device of live smoothing
void add_features(Core& core, const LiveDevice& device);

}  // namespace vesselbench
