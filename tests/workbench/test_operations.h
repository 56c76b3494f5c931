#pragma once

#include "workbench/case/operation.h"

namespace vesselbench::test {

/// Runs a real operation, found by its name, on a scene or on a surface alone.
[[nodiscard]] Outcome run(const std::string& operation, const Scene& scene,
                          const Arguments& arguments);
[[nodiscard]] Outcome run(const std::string& operation, const Surface& surface,
                          const Arguments& arguments);

/// Vertices at another place than before, on surfaces of the same triangles, and the longest way.
[[nodiscard]] std::size_t moved_vertices(const Surface& before, const Surface& after);
[[nodiscard]] double longest_way(const Surface& before, const Surface& after);  ///< [mm]

}  // namespace vesselbench::test
