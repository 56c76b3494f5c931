#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Target edge lengths of a graded mesh.
struct SizingParameters {
    double edge = 0.0;       ///< edge at the vessel's typical radius [mm], > 0
    double min_edge = 0.0;   ///< shortest edge [mm], > 0
    double max_edge = 0.0;   ///< longest edge [mm], >= min_edge
    double gradation = 1.5;  ///< largest ratio of neighbouring edges [-], > 1
    double turn = 0.7;       ///< an edge spans at most this angle of the curved wall [rad]
    double gap_edges = 1.0;  ///< edges that fit into the gap to the opposite wall [-]
    /// For prints: edges are as long as a deviation of this much allows, but at most 0.7 of the
    /// vessel's radius, if that is longer than the rules above permit (not that of gaps) [mm]; 0:
    /// no.
    double resolution = 0.0;
};

/// The median radius over the wall's area [mm]. \throw InvalidInput without a wall
[[nodiscard]] double usual_radius(const Surface& surface, const std::vector<double>& radii);

/// Target edge length at every vertex [mm], #V: the smallest of edge * radius / typical radius, of
/// the length the curvature permits, and of the gap to the opposite wall outside; within the
/// limits; then reduced until neighbouring edges differ by at most `gradation`.
/// \throw InvalidInput if a parameter is out of its range
[[nodiscard]] std::vector<double> sizing_field(const Surface& surface,
                                               const std::vector<double>& radii,
                                               const SizingParameters& parameters,
                                               const Progress& progress = {});

/// Reduces sizes until |size(u) - size(v)| <= slope |u - v| along every edge.
/// \throw Cancelled if the user cancels
void limit_slope(const Surface& surface, double slope, std::vector<double>& sizes,
                 const Progress& cancel = {});

/// Slope of the size that keeps neighbouring edges within `gradation` of each other: a quarter of
/// the factor minus 1, because real triangles scatter about their size.
[[nodiscard]] double slope_of(double gradation);

}  // namespace vesselbench
