#pragma once

#include <memory>
#include <vector>

#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/openings/surface_ends.h"

namespace vesselbench {

/// An end of a vessel that is too short for a centerline.
struct UnlinedEnd {
    Vec3 place = Vec3::Zero();  ///< on its wall [mm]
    double diameter = 0.0;      ///< of the largest circle in its sections [mm]
    double length = 0.0;        ///< beyond them [mm]
    bool sac = false;           ///< it is wider than its neck, or than its parent: an aneurysm
    /// Diameter of the vessel that it is the rest of, without a neck and about as wide [mm]; 0: it
    /// is narrower, or has a neck.
    double rest_of = 0.0;
};

/// The stubs that may be vessels' ends: at least a quarter as long as they are wide beyond their
/// parents' inscribed spheres, half as wide as their parents, and no part of another end.
[[nodiscard]] std::vector<UnlinedEnd> unlined_ends(const Surface& surface,
                                                   const CenterlineGraph& graph,
                                                   const std::vector<Stub>& stubs,
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
