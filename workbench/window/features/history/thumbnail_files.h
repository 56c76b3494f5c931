#pragma once

#include <filesystem>
#include <optional>

#include "gpu/png.h"

namespace vesselbench {

/// The file of a project's thumbnail in the cache folder; the same for all ways to write the
/// project's path.
[[nodiscard]] std::filesystem::path thumbnail_file(const std::filesystem::path& cache,
                                                   const std::filesystem::path& project);

/// Writes a project's thumbnail, for this user alone; of very many, the oldest are deleted. A
/// folder that cannot be written is no error: the thumbnail is then missing.
void save_thumbnail(const std::filesystem::path& cache, const std::filesystem::path& project,
                    const ClearPicture& picture);

/// None if it is missing or damaged.
[[nodiscard]] std::optional<ClearPicture> saved_thumbnail(const std::filesystem::path& cache,
                                                          const std::filesystem::path& project);

}  // namespace vesselbench
