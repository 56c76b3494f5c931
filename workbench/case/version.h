#pragma once

#include <string>

namespace vesselbench {

/// Version of this build, "0.2.0".
[[nodiscard]] std::string version();

}  // namespace vesselbench
