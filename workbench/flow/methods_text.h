#pragma once

#include <string>
#include <vector>

#include "workbench/flow/flow_results.h"

namespace vesselbench {

/// A paragraph for a paper's methods: mesh, fluid, boundary conditions, solver, when it ended, and
/// what the figures mean, with the numbers of this case. References are in brackets: [1], [2].
[[nodiscard]] std::string methods_text(const FlowResults& results);

/// Its references, in their order.
[[nodiscard]] std::vector<std::string> method_references(const FlowResults& results);

}  // namespace vesselbench
