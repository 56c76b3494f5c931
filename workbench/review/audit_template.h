#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// The files workbench/review/*.html, by name.
[[nodiscard]] const std::map<std::string, std::string>& audit_templates();

}  // namespace vesselbench
