#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Compares a prepared model with the surface before its ends were opened.
/// \throw AlgorithmFailure if a vessel misses over more than 3 of its diameters; the text lists
/// them
void check_vessels(const Surface& before, const Surface& after, const Progress& progress);

/// \throw AlgorithmFailure if the cuts opened a vessel's side; the text names the opening
void check_openings(const Surface& before, const Surface& after);

}  // namespace vesselbench
