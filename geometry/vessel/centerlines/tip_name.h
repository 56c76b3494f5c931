#pragma once

#include <cstddef>
#include <string>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// "Vessel end, 4.5 mm", with the diameter at a tip node.
[[nodiscard]] std::string tip_name(const CenterlineGraph& graph, std::size_t tip);

}  // namespace vesselbench
