#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// An end that was made: the surface beyond it, and just before it, comes from clipping, blending
/// and extruding, and has no counterpart in the source.
struct MadeEnd {
    Vec3 centre;
    Vec3 outward;           ///< unit length
    double diameter = 0.0;  ///< of the circle of the same area [mm]
};

/// The openings after each edit of the step "openings" in a variant, so that an end that was
/// extended is known by the place from which it was.
/// \throw Cancelled; as Session::scene_after
[[nodiscard]] std::vector<MadeEnd> made_ends(Session& session, const std::string& variant,
                                             const Progress& progress = {});

/// 1 at the wall's vertices that have a counterpart in the source, #V: those that are not near an
/// end, or beyond it.
[[nodiscard]] std::vector<std::uint8_t> comparable_vertices(const Surface& surface,
                                                            const std::vector<MadeEnd>& ends);

/// The points of those vertices. \param comparable as found, #V
[[nodiscard]] Positions comparable_points(const Surface& surface,
                                          const std::vector<std::uint8_t>& comparable);

}  // namespace vesselbench
