#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace vesselbench {

/// A mustache template filled in with a document, for HTML: texts are escaped, and control
/// characters, which HTML has no signs for, are shown as printable() does.
[[nodiscard]] std::string rendered_template(const std::string& text,
                                            const nlohmann::ordered_json& document);

}  // namespace vesselbench
