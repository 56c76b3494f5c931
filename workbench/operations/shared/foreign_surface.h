#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The unit in which read_foreign_surface() reads a file: as given, or mm.
[[nodiscard]] std::string assumed_units(const std::string& given);

/// Reads a surface file in a worker process, by the operation load-surface: the program survives
/// whatever a damaged file does to its reader. [mm]
/// \param units of the file: "mm", "cm" or "m"; empty: mm, to avoid a guess
/// \throw UsageError for other units; what read_surface throws; InvalidInput if the reader crashed
[[nodiscard]] Surface read_foreign_surface(const std::string& file, const std::string& units = "",
                                           const Progress& progress = {});

}  // namespace vesselbench
