#pragma once

#include <string>

#include "smoothing/filters/new_crossings.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Tells what was taken back so that walls do not pass through each other; nothing if nothing was.
/// \param mover what wanted to move them: "filter", "brush"
/// \param remedy for crossings that are left
void warn_of_crossings(const TakenBack& taken, const std::string& mover, const std::string& remedy,
                       Outcome& outcome);

}  // namespace vesselbench
