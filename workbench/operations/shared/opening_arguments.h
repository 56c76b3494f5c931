#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/vessel/openings/openings.h"
#include "workbench/case/parameter.h"

namespace vesselbench {

/// The decisions of clip-opening as its arguments `planes`, `names` and `closings`: records of
/// these fields.
[[nodiscard]] std::vector<Parameter> plane_fields();
[[nodiscard]] std::vector<Parameter> name_fields();
[[nodiscard]] std::vector<Parameter> closing_fields();

/// A record for each opening, without its patch.
[[nodiscard]] Records planes_argument(std::span<const PlannedOpening> openings);

/// The openings of `planes`, without their patches; empty if a normal is not of unit length.
[[nodiscard]] std::vector<PlannedOpening> openings_in(const Records& planes);

[[nodiscard]] Records names_argument(std::span<const Patch> patches);

[[nodiscard]] std::vector<Patch> patches_in(const Records& names);

/// A record for each end that gets no opening.
[[nodiscard]] Records closings_argument(std::span<const PlannedClosing> closings);

[[nodiscard]] std::vector<PlannedClosing> closings_in(const Records& closings);

/// What a plan that was read back says about its ends.
[[nodiscard]] std::vector<EndRecord> ends_of(const OpeningPlan& plan);

/// The patch of an opening as `kind` and `name` ask for it: a part that is not given stays; without
/// a name it is called as its kind.
/// \param present none: an outlet without a name
[[nodiscard]] Patch chosen_patch(const std::optional<Patch>& present,
                                 const std::optional<std::string>& kind,
                                 const std::optional<std::string>& name);

}  // namespace vesselbench
