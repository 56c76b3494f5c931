#pragma once

#include <span>
#include <string>
#include <vector>

namespace vesselbench {

/// The names that the user may have meant by `name`: few letters differ, or one begins with the
/// other; the nearest first, at most three.
[[nodiscard]] std::vector<std::string> near_names(const std::string& name,
                                                  std::span<const std::string> names);

/// "; did you mean 'a' or 'b'?", or empty if no name is near.
[[nodiscard]] std::string did_you_mean(const std::string& name, std::span<const std::string> names);

}  // namespace vesselbench
