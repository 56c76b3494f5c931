#pragma once

#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// One kind of defect that prevents a surface from being filled with tetrahedra, or from being
/// printed.
struct SurfaceProblem {
    enum class Kind {
        NotFinite,
        Degenerate,
        Duplicate,
        Gap,
        NonManifoldEdge,
        NonManifoldVertex,
        Orientation,
        InsideOut,
        SeveralParts,
        SelfIntersection,
        Sliver,
    };

    Kind kind = Kind::Gap;
    std::size_t count = 0;              ///< number of places
    Positions places;                   ///< of the first few of them [mm]
    std::vector<TriangleId> triangles;  ///< the triangles affected, ascending
};

/// With the number of its places, the first of them, and the operations that mend it.
[[nodiscard]] Diagnostic diagnostic_of(const SurfaceProblem& problem);

/// All defects of a surface, the most severe first; none: closed, 2-manifold, oriented outward, one
/// part, free of self-intersections, slivers and degenerate triangles.
[[nodiscard]] std::vector<SurfaceProblem> surface_problems(const Surface& surface,
                                                           const Progress& progress = {});

/// True if the defect rules out filling the surface; slivers do not.
[[nodiscard]] bool is_obstacle(const SurfaceProblem& problem);

}  // namespace vesselbench
