#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

// What other libraries make of a surface at the same number of triangles, with the settings that
// serve a vessel best: topology kept, boundaries kept.

struct DecimationRun {
    Surface surface;
    double seconds = 0.0;  ///< without conversions
};

[[nodiscard]] DecimationRun vtk_quadric(const Surface& surface, std::size_t triangles);
[[nodiscard]] DecimationRun vtk_pro(const Surface& surface, std::size_t triangles);

/// Garland & Heckbert's quadrics, with placements that turn no normal too far.
[[nodiscard]] DecimationRun cgal_quadric(const Surface& surface, std::size_t triangles);

/// Half-edge collapses by quadrics, with normals that may turn by 75 degrees at most.
[[nodiscard]] DecimationRun openmesh_quadric(const Surface& surface, std::size_t triangles);

}  // namespace vesselbench::bench
