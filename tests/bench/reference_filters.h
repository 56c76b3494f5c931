#pragma once

#include <functional>

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

/// One run of a filter on a fixed input; returns the seconds it took. What only brings the input
/// into the library's own form is left out of the time.
using Run = std::function<double()>;

/// vtkSmoothPolyDataFilter, relaxation 0.5, no feature-edge or boundary smoothing; single precision
/// as VTK's own surfaces.
[[nodiscard]] Run vtk_laplace(const Surface& surface, int iterations);

/// vtkWindowedSincPolyDataFilter, coordinates normalised, pass band 0.1; single precision.
[[nodiscard]] Run vtk_windowed_sinc(const Surface& surface, int iterations);

/// OpenMesh' JacobiLaplaceSmootherT, tangential and normal, C0; double precision. The half-edge
/// mesh is made before, its weights are part of the time.
[[nodiscard]] Run openmesh_laplace(const Surface& surface, int iterations);

}  // namespace vesselbench::bench
