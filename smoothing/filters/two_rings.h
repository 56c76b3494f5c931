#pragma once

#include "geometry/kernel/topology.h"

namespace vesselbench {

/// Neighbours of every vertex within two rings, itself excluded, each row ascending.
[[nodiscard]] CompressedRows two_rings(const Topology& topology);

}  // namespace vesselbench
