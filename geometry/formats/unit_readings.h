#pragma once

#include <string_view>
#include <vector>

#include "geometry/formats/length_unit.h"

namespace vesselbench {

/// The units that a doubt about a file's unit names (UnitGuess::doubt), the likelier first.
[[nodiscard]] std::vector<LengthUnit> units_read(std::string_view doubt);

}  // namespace vesselbench
