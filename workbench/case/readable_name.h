#pragma once

#include <string>

namespace vesselbench {

/// A name of the command line as people write it: "clip-opening" is "Clip opening", "tau_max" is
/// "Tau max".
[[nodiscard]] std::string readable(const std::string& name);

/// "find_caps" and "find-caps" are "find caps".
[[nodiscard]] std::string with_blanks(std::string name);

/// With a capital first letter: words stay as they are.
[[nodiscard]] std::string readable_sentence(std::string sentence);

}  // namespace vesselbench
