#pragma once

#include <optional>
#include <string>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// What a vessel end is in the model.
enum class EndRole { Inlet, Open, Closed };

[[nodiscard]] std::string to_string(EndRole role);  ///< "inlet", "open", "closed"

/// Of an end of a plan.
[[nodiscard]] EndRole planned_role(const OpeningPlan& plan, const EndRecord& end);

/// None: there is no such role.
[[nodiscard]] std::optional<EndRole> end_role(const std::string& text);

}  // namespace vesselbench
