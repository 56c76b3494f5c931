#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// The files of page/ by name: template (mustache), style and script of the table's page, embedded
/// into the program.
[[nodiscard]] const std::map<std::string, std::string>& batch_page_texts();

}  // namespace vesselbench
