#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/local_remesh.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/case/parameter.h"

namespace vesselbench {

/// `at` and `within`: an operation on the whole surface is done around a place only.
/// \param what "remesh"
[[nodiscard]] std::vector<Parameter> near_parameters(const std::string& what);

/// The surroundings that are given; none: the whole surface. `within` is resolved: without it, the
/// vessel's radius at the place.
[[nodiscard]] std::optional<NearPlace> near_place(const Surface& surface,
                                                  const SurfaceDistance& places,
                                                  Arguments& arguments);

}  // namespace vesselbench
