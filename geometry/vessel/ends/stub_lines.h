#pragma once

#include <memory>
#include <vector>

#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/ends/surface_ends.h"

namespace vesselbench {

/// The stubs that are no part of another end, as a corner of an oblique cap is.
[[nodiscard]] std::vector<Stub> stubs_apart(const std::vector<Stub>& stubs,
                                            const CenterlineGraph& graph,
                                            const std::vector<SurfaceEnd>& ends);

/// Lines for a plan that has to open some ends, and what has no line still.
struct LinesAndStubs {
    std::shared_ptr<const CenterlineGraph> graph;
    std::vector<Stub> stubs;
};

/// The surface's lines; stubs that `points` mean get lines of their own.
/// \param points near vessel ends [mm]
/// \throw what centerlines_of throws
[[nodiscard]] LinesAndStubs lines_to_ends(const Surface& surface, const Positions& points,
                                          const Progress& progress = {});

}  // namespace vesselbench
