#pragma once

#include <filesystem>

namespace vesselbench {

/// Whether there is a file or folder of this name; links are followed.
/// \throw IoError that names the file if that cannot be found out: for a link that leads to itself,
/// or in a folder that may not be entered
[[nodiscard]] bool file_exists(const std::filesystem::path& path);

/// Refuses devices, pipes and sockets, which could block a reader or never end. Files, folders and
/// what does not exist pass.
/// \throw IoError that names the file; also as file_exists()
void refuse_special_file(const std::filesystem::path& path);

}  // namespace vesselbench
