#pragma once

#include <filesystem>

namespace vesselbench {

/// Refuses devices, pipes and sockets, which could block a reader or never end. Files, folders and
/// what does not exist pass.
/// \throw IoError that names the file
void refuse_special_file(const std::filesystem::path& path);

}  // namespace vesselbench
