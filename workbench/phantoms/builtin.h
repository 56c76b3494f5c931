#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// Texts of cases/phantoms/*.json by name, embedded at build time.
[[nodiscard]] const std::map<std::string, std::string>& builtin_phantom_texts();

}  // namespace vesselbench
