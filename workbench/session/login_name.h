#pragma once

#include <string>

namespace vesselbench {

/// Of the user that runs the program; "unknown" if the system has none.
[[nodiscard]] std::string login_name();

}  // namespace vesselbench
