#pragma once

#include <functional>

#include "geometry/kernel/surface.h"

namespace vesselbench::bench {

/// One run of a filter on a fixed input; returns the seconds it took. Conversion of the input to
/// the library's own form is not timed.
using Run = std::function<double()>;

/// vtkSmoothPolyDataFilter, relaxation 0.5, no feature-edge or boundary smoothing; single
/// precision, as in VTK's own surfaces.
[[nodiscard]] Run vtk_laplace(const Surface& surface, int iterations);

/// vtkWindowedSincPolyDataFilter, coordinates normalised, pass band 0.1; single precision.
[[nodiscard]] Run vtk_windowed_sinc(const Surface& surface, int iterations);

/// OpenMesh's JacobiLaplaceSmootherT, tangential and normal, C0; double precision. The half-edge
/// mesh is built beforehand; its weights are timed.
[[nodiscard]] Run openmesh_laplace(const Surface& surface, int iterations);

}  // namespace vesselbench::bench
