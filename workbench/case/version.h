#pragma once

#include <string>

namespace vesselbench {

/// Version of this build, "0.1.0".
[[nodiscard]] std::string version();

}  // namespace vesselbench
