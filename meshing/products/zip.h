#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// A ZIP archive of named parts, each deflated, by libzip; all parts are dated 1 January 1980, so
/// that the same parts give the same bytes.
/// \throw InvalidInput if a part is 4 GiB or larger, AlgorithmFailure if libzip fails, Cancelled
[[nodiscard]] std::string zip_archive(const std::vector<std::pair<std::string, std::string>>& parts,
                                      const Progress& progress = {});

}  // namespace vesselbench
