#pragma once

#include "meshing/remeshing/remesh_state.h"

namespace vesselbench {

/// The last passes of remeshing: they work on single triangles, which averages do not see, in the
/// order of their numbers or their quality. The same input gives the same bits.

/// Raises the mean quality by flips and moves of single vertices.
void polish(RemeshState& state);

/// Improves the triangles that are worse than `quality` (the smaller of 1 - equiangle skewness and
/// radius ratio) or differ in size from a neighbour: flips, moves of single vertices, collapses.
/// \return the worst remaining quality
double improve_worst(RemeshState& state, double quality);

}  // namespace vesselbench
