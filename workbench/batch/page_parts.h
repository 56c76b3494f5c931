#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace vesselbench {

/// As the policy (CSP) of a page names a script or a style that it allows.
[[nodiscard]] std::string source_hash(const std::string& text);

/// A text for a template. Mustache leaves out what is false: an empty text would show the one of
/// the level above.
[[nodiscard]] nlohmann::ordered_json or_false(const std::string& text);

}  // namespace vesselbench
