#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// What a user should know about the ends, worst first. Small closed ends share a warning, except
/// the open rims among them, and vessels that an image's border cuts.
[[nodiscard]] std::vector<Diagnostic> end_warnings(const OpeningPlan& plan);

/// Of flat ends that were kept although the vessels behind them run another way; none if there
/// are none.
/// \param openings of the report (record_of)
[[nodiscard]] std::optional<Diagnostic> tilt_warning(const nlohmann::ordered_json& openings);

/// Where the blood of a portal vein is taken to enter.
[[nodiscard]] Diagnostic portal_inlet(const Surface& surface);

/// What to say of outlets that look like inlets; none if there are none.
[[nodiscard]] std::optional<Diagnostic> further_inlets(const Surface& surface);

}  // namespace vesselbench
