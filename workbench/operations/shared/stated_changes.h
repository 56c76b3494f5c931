#pragma once

#include "workbench/case/operation.h"
#include "workbench/case/stated_change.h"

namespace vesselbench {

/// What several operations state (Operation::may_change).

/// Vertices move, and nothing else changes.
[[nodiscard]] inline StatedChange moved_vertices(const Scene&, const Outcome&) {
    return {.keeps_triangles = true};
}

/// Other triangles of the same vessels; what touched at a vertex may come apart, and a loop with
/// it.
[[nodiscard]] inline StatedChange kept_vessels(const Scene&, const Outcome&) {
    return {.parts = kAnyGain, .handles = kAnyLoss};
}

}  // namespace vesselbench
