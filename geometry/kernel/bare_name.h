#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// Name of a file or folder without the folders it lies in, for error texts.
[[nodiscard]] std::string bare_name(const std::filesystem::path& path);

}  // namespace vesselbench
