#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// The decisions of clip-opening as its arguments `planes` and `names`.

/// 10 numbers per opening: tip, point of the plane, unit normal out of the vessel, 1 if a cap is
/// kept.
[[nodiscard]] std::vector<double> planes_argument(std::span<const PlannedOpening> openings);

/// The openings of `planes`, without their patches; empty if there are not 10 numbers for each, or
/// a normal is not of unit length.
[[nodiscard]] std::vector<PlannedOpening> openings_in(const std::vector<double>& planes);

/// "inlet:inlet,outlet:outlet_1"
[[nodiscard]] std::string names_argument(std::span<const Patch> patches);

/// The patches of `names`, up to the first entry that is not kind:name.
/// \throw InvalidInput if a kind is unknown
[[nodiscard]] std::vector<Patch> patches_in(const std::string& names);

/// The patch of an opening as `kind` and `name` ask for it: a part that is not given stays; without
/// a name it is called as its kind.
/// \param present none: an outlet without a name
[[nodiscard]] Patch chosen_patch(const std::optional<Patch>& present,
                                 const std::optional<std::string>& kind,
                                 const std::optional<std::string>& name);

}  // namespace vesselbench
