#include "geometry/formats/unit_readings.h"

#include <algorithm>
#include <string>
#include <utility>

namespace vesselbench {

std::vector<LengthUnit> units_read(std::string_view doubt) {
    std::vector<std::pair<std::size_t, LengthUnit>> found;
    for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre,
                                  LengthUnit::Micrometre})
        if (const auto at = doubt.find("in " + to_string(unit) + " it is ");
            at != std::string_view::npos)
            found.emplace_back(at, unit);
    std::ranges::sort(found);
    std::vector<LengthUnit> units;
    for (const auto& [at, unit] : found) units.push_back(unit);
    return units;
}

}  // namespace vesselbench
