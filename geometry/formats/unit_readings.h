#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/formats/length_unit.h"
#include "geometry/formats/vessel_size.h"

namespace vesselbench {

/// How large a surface is in a unit: "in mm it is 98 mm long with a typical radius of 1.2 mm".
/// \param size in the file's unit
[[nodiscard]] std::string reading_text(const VesselSize& size, LengthUnit unit);

/// The units that a text of readings (UnitGuess::doubt) names, in its order.
[[nodiscard]] std::vector<LengthUnit> units_read(std::string_view readings);

}  // namespace vesselbench
