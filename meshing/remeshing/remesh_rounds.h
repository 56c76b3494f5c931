#pragma once

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "meshing/remeshing/remesher.h"

namespace vesselbench {

inline constexpr int kRemeshRounds = 8;  ///< of split, collapse, flip, relax

/// Runs all rounds of remeshing and the improvement of triangles that follows them.
/// \param first_round earlier rounds are left out
/// \throw as Remesher's passes
[[nodiscard]] Surface remeshed(Remesher& remesher, int first_round, const Progress& progress = {});

}  // namespace vesselbench
