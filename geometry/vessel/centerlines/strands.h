#pragma once

#include <vector>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// One branch within a strand.
struct StrandPiece {
    std::size_t branch = 0;
    bool reversed = false;
};

/// Branches that continue each other straight through their furcations: one vessel to a viewer.
/// Every branch is in exactly one strand.
struct Strand {
    std::vector<StrandPiece> pieces;
    bool closed = false;
};

/// At every furcation the two branches that continue each other best (straight, of similar radius)
/// are joined; further pairs only if they are nearly straight.
[[nodiscard]] std::vector<Strand> find_strands(const CenterlineGraph& graph);

}  // namespace vesselbench
