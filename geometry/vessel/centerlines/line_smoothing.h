#pragma once

#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A line under refinement.
struct Line {
    Positions points;             ///< [mm]
    std::vector<double> radii;    ///< [mm], #points
    std::vector<double> weights;  ///< weight of each point when the line is smoothed [-], #points
    bool closed = false;          ///< the last point is followed by the first
};

/// Value and first two derivatives by arc length of a quadratic fitted to a line near one of its
/// points (local regression; unlike averaging it does not shrink bends).
/// Source: Cleveland and Devlin, "Locally weighted regression", JASA 83, 1988.
struct LineFit {
    Vec3 point = Vec3::Zero();
    Vec3 tangent = Vec3::UnitZ();  ///< unit
    Vec3 curvature = Vec3::Zero();
    double radius = 0.0;
};

/// Fits at all points of a line.
/// \param window half width in local radii [-]
/// \param least smallest half width [mm]
[[nodiscard]] std::vector<LineFit> fit_line(const Line& line, double window, double least);

/// Points on the polyline spaced by `spacing` times the local radius, ends included; radii are
/// interpolated, weights are 1. A line has at least `fewest` points.
[[nodiscard]] Line resampled(const Line& line, double spacing, std::size_t fewest);

[[nodiscard]] double line_length(const Line& line);

}  // namespace vesselbench
