#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// The decisions of clip-opening as its arguments `planes` and `names`.

/// 10 numbers per opening: tip, point of the plane, unit normal out of the vessel, 1 if a cap is
/// kept, 2 if a rim is capped as it is, 3 if only its name changes.
[[nodiscard]] std::vector<double> planes_argument(std::span<const PlannedOpening> openings);

/// The openings of `planes`, without their patches; empty if there are not 10 numbers for each, or
/// a normal is not of unit length.
[[nodiscard]] std::vector<PlannedOpening> openings_in(const std::vector<double>& planes);

/// "inlet:inlet,outlet:outlet_1"; a comma in a name becomes %2C, a percent sign %25
[[nodiscard]] std::string names_argument(std::span<const Patch> patches);

/// 4 numbers per end that gets no opening: place, way.
[[nodiscard]] std::vector<double> closings_argument(std::span<const PlannedClosing> closings);

/// The same read back; empty if there are not 4 numbers for each, or a way is unknown.
[[nodiscard]] std::vector<PlannedClosing> closings_in(const std::vector<double>& closings);

/// What a plan that was read back says about its ends.
[[nodiscard]] std::vector<EndRecord> ends_of(const OpeningPlan& plan);

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
