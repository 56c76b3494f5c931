#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/vessel/openings/opening_place.h"

namespace vesselbench {

/// "tilted by 5 degrees against the vessel's axis"; empty if it is less than worth a mention.
[[nodiscard]] std::string tilt_text(const OpeningPlace& place);

/// What a user should know about the place of a cut: a bend, a part of the branch given up, a
/// direction that is not known well.
[[nodiscard]] std::vector<Diagnostic> place_warnings(const OpeningPlace& place);

}  // namespace vesselbench
