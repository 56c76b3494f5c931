#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// Texts of gpu/shaders/* by file name, embedded at build time.
[[nodiscard]] const std::map<std::string, std::string>& shader_texts();

}  // namespace vesselbench
