#pragma once

#include <string>

#include "geometry/vessel/ends/end_choice.h"

namespace vesselbench {

/// Why an end is not opened: what it is taken for, and its odds.
[[nodiscard]] std::string closed_text(const EndVerdict& verdict);

/// True if it is no opening, and rather an aneurysm than a bump of the wall.
[[nodiscard]] bool looks_like_sac(const EndVerdict& verdict);

}  // namespace vesselbench
