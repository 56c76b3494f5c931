#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// "writing a.stl", for progress.
[[nodiscard]] std::string writing_text(const std::filesystem::path& path);

/// All bytes of a file.
/// \throw IoError if it is missing, a folder, a device or pipe, or cannot be read to its end
[[nodiscard]] std::string file_content(const std::filesystem::path& path);

/// Writes a file completely or not at all (PendingFiles, for one file).
/// \throw IoError if the folder is missing or read-only, or the disk is full
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// The same for bytes in memory. \throw Cancelled too
void write_file(const std::filesystem::path& path, std::string_view bytes,
                const Progress& progress = {});

}  // namespace vesselbench
