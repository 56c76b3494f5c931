#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Splits every triangle into four and smooths, `iterations` times, by Loop's rules: the surface
/// converges to a C2 one, slightly inward. Rims between patches and open boundaries follow the rule
/// for boundary curves (a cubic B-spline of their own vertices), so flat caps stay flat; where more
/// than two of them meet, the vertex is fixed. Patches are kept; attributes are averaged like
/// positions of new vertices, and kept at old ones. Source: Loop, "Smooth subdivision surfaces
/// based on triangles", 1987; boundary rules after Hoppe et al., "Piecewise smooth surface
/// reconstruction", SIGGRAPH 1994.
/// \param iterations 1 to 6; each multiplies the number of triangles by four
/// \throw InvalidInput if iterations is out of range, the surface is not a manifold, or the result
///        would have more than 40 million triangles
[[nodiscard]] Surface subdivide(const Surface& surface, int iterations,
                                const Progress& progress = {});

}  // namespace vesselbench
