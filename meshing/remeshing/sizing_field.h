#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How long the edges of a graded mesh shall be.
struct SizingParameters {
    double edge = 0.0;       ///< edge where the vessel has its usual radius [mm], > 0
    double min_edge = 0.0;   ///< no edge shall be shorter [mm], > 0
    double max_edge = 0.0;   ///< no edge shall be longer [mm], >= min_edge
    double gradation = 1.5;  ///< neighbouring edges differ by at most this factor [-], > 1
    double turn = 0.7;       ///< an edge spans at most this angle of the curved wall [rad]
    double gap_edges = 1.0;  ///< edges that fit into the gap to the opposite wall outside [-]
};

/// The radius that half of the wall's area stays below [mm]. \throw InvalidInput without a wall
[[nodiscard]] double usual_radius(const Surface& surface, const std::vector<double>& radii);

/// Wanted edge length at every vertex [mm], #V: the smallest of edge * radius / usual radius, of
/// what the curvature allows, and of the gap to the wall opposite outside; within the limits; then
/// reduced until it grows so slowly that neighbouring edges differ by at most `gradation`.
/// \throw InvalidInput if a parameter is out of its range
[[nodiscard]] std::vector<double> sizing_field(const Surface& surface,
                                               const std::vector<double>& radii,
                                               const SizingParameters& parameters,
                                               const Progress& progress = {});

/// Reduces sizes until |size(u) - size(v)| <= slope |u - v| along every edge.
void limit_slope(const Surface& surface, double slope, std::vector<double>& sizes);

/// Slope of the size that keeps neighbouring edges within `gradation` of each other: a quarter of
/// the factor that is above 1, for real triangles scatter about their size.
[[nodiscard]] double slope_of(double gradation);

}  // namespace vesselbench
