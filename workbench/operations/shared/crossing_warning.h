#pragma once

#include <string>

#include "smoothing/filters/new_crossings.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Warns if displacements were reverted to keep walls from passing through each other.
/// \param mover the cause: "filter", "brush"
/// \param remedy for the remaining crossings
void warn_of_crossings(const TakenBack& taken, const std::string& mover, const std::string& remedy,
                       Outcome& outcome);

}  // namespace vesselbench
