#pragma once

#include <map>
#include <string>

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// The arguments of clip-opening that name the same ends by their places: inlet, open and closed,
/// those that name any. A remedy that names ends names all of them, so that none that was named
/// already is lost.
[[nodiscard]] std::map<std::string, std::string> end_arguments(const OpeningPlanOptions& options);

}  // namespace vesselbench
