#pragma once

#include <string>
#include <vector>

#include "smoothing/filters/new_crossings.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Warns if displacements were reverted to keep walls from passing through each other.
/// \param code of the catalogue, by what moved them: "brush-crosses-walls"
/// \param remedies for the remaining crossings
void warn_of_crossings(const TakenBack& taken, const std::string& code,
                       std::vector<Remedy> remedies, Outcome& outcome);

}  // namespace vesselbench
