#pragma once

#include "geometry/kernel/topology.h"

namespace vesselbench {

/// Neighbours of every vertex within two rings, without itself, each row ascending.
[[nodiscard]] CompressedRows two_rings(const Topology& topology);

}  // namespace vesselbench
