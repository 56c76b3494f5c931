#include "geometry/formats/unit_readings.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

std::string beginning(LengthUnit unit) {
    return "in " + to_string(unit) + " it is ";
}

}  // namespace

std::string reading_text(const VesselSize& size, LengthUnit unit) {
    const double factor = millimetres_per(unit);
    const std::string text = beginning(unit) + formatted(factor * size.extent) + " mm long";
    if (size.radius == 0.0) return text;
    return text + " with a typical radius of " + formatted(factor * size.radius) + " mm";
}

std::vector<LengthUnit> units_read(std::string_view readings) {
    std::vector<std::pair<std::size_t, LengthUnit>> found;
    for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre,
                                  LengthUnit::Micrometre})
        if (const auto at = readings.find(beginning(unit)); at != std::string_view::npos)
            found.emplace_back(at, unit);
    std::ranges::sort(found);
    std::vector<LengthUnit> units;
    for (const auto& [at, unit] : found) units.push_back(unit);
    return units;
}

}  // namespace vesselbench
