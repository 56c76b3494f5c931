#pragma once

#include <map>
#include <string>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// The arguments of clip-opening that name ends by their places [mm]: inlet, open and closed, those
/// that name any. A remedy that names ends names all of them, so that none that was named already
/// is lost.
[[nodiscard]] std::map<std::string, std::string> end_arguments(const Positions& inlets,
                                                               const Positions& open,
                                                               const Positions& closed);

}  // namespace vesselbench
