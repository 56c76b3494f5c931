#pragma once

#include <string>

namespace vesselbench {

/// A word of a command line, quoted for a shell if that is necessary.
[[nodiscard]] std::string shell_quoted(const std::string& text);

/// The text with the project's path in its commands: operations do not know where the project is,
/// and write "vesselbench change project.vbench 4 ...".
[[nodiscard]] std::string with_project(const std::string& text, const std::string& project);

}  // namespace vesselbench
