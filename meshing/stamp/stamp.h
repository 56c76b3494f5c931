#pragma once

#include <cstddef>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/stamp/corefinement.h"
#include "meshing/stamp/tool_body.h"

namespace vesselbench {

struct StampParameters {
    StampMode mode = StampMode::Subtract;
    /// Width on each side of the seam over which wall and tool are faired into each other [mm], >=
    /// 0; 0 keeps the crease.
    double blend = 0.0;
};

struct StampReport {
    double volume_change = 0.0;   ///< of the vessel [mm^3]: negative if something was removed
    std::size_t replaced = 0;     ///< triangles before
    std::size_t replacement = 0;  ///< triangles after
    double edge = 0.0;            ///< of the new triangles [mm]
    double influence = 0.0;       ///< distance from the tool up to which vertices may move [mm]
    std::size_t components_before = 0, components_after = 0;
    int genus_before = 0, genus_after = 0;
};

struct Stamped {
    Surface surface;
    StampReport report;
};

/// Subtracts a tool's body from a vessel or adds it: the wall is cut along the tool, both are
/// joined there, remeshed with triangles of the neighbouring size and faired with continuity 1. The
/// faired wall never enters the tool: a gap is as wide as the slab that was subtracted. Only the
/// wall that the tool reaches is touched; vertices farther from the tool than the report's
/// influence keep their bits. Patches are kept. \param places of the surface
/// \throw InvalidInput if a parameter is out of its range or the surface is no manifold there;
///        AlgorithmFailure, with its place, if the tool touches nothing, removes or adds more than
///        half of the vessel, cuts an opening's cap, is thinner than the triangles, or if the
///        result would not be sound: closed as before, manifold and free of new crossings;
///        Cancelled
[[nodiscard]] Stamped stamp(const Surface& surface, const SurfaceDistance& places,
                            const ToolBody& tool, const StampParameters& parameters,
                            const Progress& progress = {});

/// Mean edge of the triangles that a tool reaches [mm]; 0: it reaches none.
[[nodiscard]] double mean_edge_at(const Surface& surface, const SurfaceDistance& places,
                                  const ToolBody& tool);

}  // namespace vesselbench
