#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A handle of a surface: a ring that one can go around, and the waist where it is narrowest.
struct SurfaceHandle {
    Vec3 centre = Vec3::Zero();  ///< [mm] mean of the waist
    double width = 0.0;          ///< [mm] diameter of a circle as long as the waist
    double length = 0.0;         ///< [mm] of a short way around it on the surface
};

/// The handles of the first component, the narrowest first; two whose waists cross count as one. A
/// waist is a shortest loop that cannot be drawn together: through a vertex, the shortest one over
/// the edges that neither a tree of shortest paths nor a tree of triangles that avoids it has;
/// through vertices of that loop, again, until it gets no shorter. Open rims count as filled.
/// Source: Erickson, Whittlesey, "Greedy optimal homotopy and homology generators", SODA 2005.
/// \throw InvalidInput unless the surface is a 2-manifold and oriented; Cancelled if the user cancels
[[nodiscard]] std::vector<SurfaceHandle> handles_of(const Surface& surface,
                                                    const Progress& cancel = {});

}  // namespace vesselbench
