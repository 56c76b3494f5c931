#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

// What the arguments of type File say about a worker: what it may read, and the memory for it.

/// Memory for reading the operation's files [bytes]; none if it reads no file.
[[nodiscard]] std::optional<std::uint64_t> reader_memory(const Operation& operation,
                                                         const Arguments& arguments);

/// The name of the foreign file read by the operation, without its folder; none if there is none.
[[nodiscard]] std::optional<std::string> file_read_by(const Operation& operation,
                                                      const Arguments& arguments);

/// What the operation has to be able to open: its files and folders, and of a detached header also
/// the folder that it lies in, and of a label map the table beside it that names its labels.
[[nodiscard]] std::vector<std::filesystem::path> places_read_by(const Operation& operation,
                                                                const Arguments& arguments);

}  // namespace vesselbench
