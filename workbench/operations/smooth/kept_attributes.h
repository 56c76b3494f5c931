#pragma once

#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

// What `smooth keep_weights=true` leaves on the surface as vertex attributes, for export and
// pictures (thesis Figs. 5.6, 5.9, 6.4).

inline constexpr const char* kSmoothingWeight = "smoothing_weight";      ///< in [0, 1]
inline constexpr const char* kStaircaseWeight = "staircase_weight";      ///< alone, in [0, 1]
inline constexpr const char* kStaircase = "staircase";                   ///< 1 at their vertices
inline constexpr const char* kCap = "cap";                               ///< 1 at their vertices
inline constexpr const char* kNeighbourDistance = "neighbour_distance";  ///< afterwards [mm]
inline constexpr const char* kLocalError = "local_error";                ///< thesis 6.4.1 [mm]
inline constexpr const char* kMeanCurvature = "mean_curvature";          ///< afterwards [1/mm]

/// The smoothed surface with the attributes; staircase_weight and staircase only with
/// staircase=true, neighbour_distance only if neighbours are loaded. The context is found again, on
/// the CPU, from the decisions in the resolved arguments.
/// \param before the scene that was smoothed
/// \param local_error of every vertex [mm], #V
[[nodiscard]] Surface with_kept_attributes(const Scene& before, const Surface& after,
                                           const Arguments& resolved,
                                           std::vector<double> local_error);

}  // namespace vesselbench
