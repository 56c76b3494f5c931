#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace vesselbench {

/// Writes a file so that it is whole or absent: to a temporary name in the same folder, then
/// renamed. A file of that name is replaced only at the very end.
/// \throw IoError if the folder is missing or read-only, or the disk is full
void write_file(const std::string& path, const std::function<void(std::ostream&)>& write);

}  // namespace vesselbench
