#pragma once

#include <string>

namespace vesselbench {

/// A word of a command line, quoted for a shell if that is necessary.
[[nodiscard]] std::string shell_quoted(const std::string& text);

}  // namespace vesselbench
