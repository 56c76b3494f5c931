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

/// The same, and no sac and no end is lost.
[[nodiscard]] StatedChange kept_vessels_and_sacs(const Scene& before, const Outcome& outcome);

/// Adds that no wall is lost beyond a few edges and most of a vessel's radius: what lies farther
/// from the new wall was a sac or a vessel's end.
void add_kept_wall(StatedChange& stated, const Scene& before, const Outcome& outcome);

}  // namespace vesselbench
