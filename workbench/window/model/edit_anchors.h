#pragma once

#include <vector>

#include "workbench/session/snapshot.h"
#include "workbench/window/model/surface_places.h"

namespace vesselbench {

/// The places that the edits of a variant and of the trunk are about: every argument that a click
/// could name, given or decided by the operation; "3 Clip opening". In the order of the edits.
[[nodiscard]] std::vector<NamedPlace> edit_anchors(const Snapshot& snapshot,
                                                   const std::string& variant);

}  // namespace vesselbench
