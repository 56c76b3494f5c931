#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "tests/forest/truth.h"

namespace vesselbench::forest {

/// Compares surface.vtp and report.json in `result`, as `prepare` wrote them, with the truth.
///
/// Right for flow simulation: closed, manifold, one part; the trunk's end is the one inlet; each
/// end that has to be open has one opening, and no opening is elsewhere; every opening is within 2
/// degrees, or the angle of the resolution over the vessel's diameter, of perpendicular to the true
/// centerline (within a quarter diameter of the cut), or of the end's true flat rim; no vessel
/// longer than 3 of its diameters misses over 10 % of its length beyond its parent's wall, up to
/// where its sections are whole; the genus is the truth's (surfaces, where kissing vessels are
/// distinct). Right for printing: closed, manifold, one part, no vessel longer than a diameter
/// misses over 10 %, genus as above, no tubes at the ends, and nothing is added beyond the vessels.
/// \return {"right", "failures": [{"what", "text"}], "openings": [...]}
[[nodiscard]] nlohmann::ordered_json judge(const Truth& truth, const std::filesystem::path& result,
                                           bool flow);

}  // namespace vesselbench::forest
