#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

// Decimation by other libraries to the same number of triangles, with the settings that suit
// vessels best: topology and boundaries kept.

struct DecimationRun {
    Surface surface;
    double seconds = 0.0;  ///< without conversions
};

[[nodiscard]] DecimationRun vtk_quadric(const Surface& surface, std::size_t triangles);
[[nodiscard]] DecimationRun vtk_pro(const Surface& surface, std::size_t triangles);

/// Garland & Heckbert's quadrics, with a bounded change of the normals.
[[nodiscard]] DecimationRun cgal_quadric(const Surface& surface, std::size_t triangles);

/// Half-edge collapses by quadrics; normals turn by at most 75 degrees.
[[nodiscard]] DecimationRun openmesh_quadric(const Surface& surface, std::size_t triangles);

}  // namespace vesselbench::bench
