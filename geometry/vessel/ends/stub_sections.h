#pragma once

#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/stubs.h"

namespace vesselbench {

/// A section across a stub.
struct StubSection {
    double diameter = 0.0;   ///< of the circle of its area [mm]
    double inscribed = 0.0;  ///< of the largest circle about its middle [mm]
};

/// The sections from the innermost one that is the stub's own to its tip. Empty: it has none beyond
/// its parent's spheres.
[[nodiscard]] std::vector<StubSection> stub_sections(const Surface& surface,
                                                     const CenterlineGraph& graph,
                                                     const Stub& stub);

}  // namespace vesselbench
