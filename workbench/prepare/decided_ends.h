#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "workbench/prepare/end_role.h"
#include "workbench/session/snapshot.h"

namespace vesselbench {

/// What an edit decided about a vessel end.
struct DecidedEnd {
    Vec3 place = Vec3::Zero();  ///< centre of its rim or cap, or its tip [mm]
    double diameter = 0.0;      ///< of the vessel there [mm]; 0: not known
    EndRole role = EndRole::Closed;
    EditRef edit;
    std::string variant;  ///< of the edit; empty: the trunk
};

/// What the edits on the way to the current state decided about vessel ends, whoever did, by
/// falling rank: what a user named comes before what the program chose, then the newer edit before
/// the older. Edits that were removed count, too: a decision is taken back by another one. A print
/// that leaves closed ends as they are decides nothing about them.
[[nodiscard]] std::vector<DecidedEnd> decided_ends(const Snapshot& made);

}  // namespace vesselbench
