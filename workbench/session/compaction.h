#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace vesselbench {

/// What compacting a project dropped.
struct Compaction {
    std::map<std::string, std::size_t> dropped;  ///< results by operation
    std::uintmax_t before = 0, after = 0;        ///< size of the project file [bytes]
};

/// Drops the results that no variant of the current state consists of: those of undone and changed
/// edits, volume meshes above all. No edit is lost; going to a state that needs one computes it
/// again from the arguments it had resolved. Results that were read from files stay, with what
/// they were made from: the files may be gone.
/// \throw IoError if the project cannot be written, or another program holds it
[[nodiscard]] Compaction compact_project(const std::filesystem::path& project);

}  // namespace vesselbench
