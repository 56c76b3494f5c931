#pragma once

#include <vector>

#include "workbench/session/snapshot.h"
#include "workbench/window/case/surface_places.h"

namespace vesselbench {

/// places_of_edit of the edits of a variant and of the trunk, in their order, each with the edit's
/// id and operation: "3  Clip opening".
[[nodiscard]] std::vector<NamedPlace> edit_anchors(const Snapshot& snapshot,
                                                   const std::string& variant);

}  // namespace vesselbench
