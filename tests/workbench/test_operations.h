#pragma once

#include "workbench/case/operation.h"

namespace vesselbench::test {

/// Runs a real operation, found by its name, on a scene or on a surface alone.
[[nodiscard]] Outcome run(const std::string& operation, const Scene& scene,
                          const Arguments& arguments);
[[nodiscard]] Outcome run(const std::string& operation, const Surface& surface,
                          const Arguments& arguments);

}  // namespace vesselbench::test
