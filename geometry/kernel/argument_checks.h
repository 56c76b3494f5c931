#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// \throw InvalidInput unless minimum <= value <= maximum; the text names the parameter
void require_range(const char* name, double value, double minimum, double maximum);

/// \throw InvalidInput unless the value is positive and finite; the text names the parameter
void require_positive(const char* name, double value);

/// Refuses what is most likely given in a wrong unit, and would take time and memory without bound.
/// \param length [mm], of the parameter `name`
/// \param most allowed, in diagonals of the surface's bounding box [-]
/// \throw AlgorithmFailure that names the length and the longest possible one. A surface without
/// extent allows any
void require_in_proportion(const char* name, double length, const Surface& surface, double most);

}  // namespace vesselbench
