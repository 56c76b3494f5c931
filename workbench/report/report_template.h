#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// The page's template, "report.html" (mustache), embedded into the program.
[[nodiscard]] const std::map<std::string, std::string>& report_templates();

}  // namespace vesselbench
