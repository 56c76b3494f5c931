#pragma once

#include <vector>

#include "geometry/surface.h"
#include "geometry/surface_distance.h"

namespace vesselbench {

/// Points that stand for a surface, in place of its triangles.
struct SurfaceSamples {
    Positions points;                   ///< all vertices first, which stand for no area
    std::vector<double> areas;          ///< what each point stands for [mm^2]
    std::vector<TriangleId> triangles;  ///< one that each point lies in
};

/// All vertices, and the centres of the n^2 equal parts of every triangle, n from its longest edge
/// so that they are no wider apart than the spacing; n is 24 at most.
/// \param spacing [mm], > 0
[[nodiscard]] SurfaceSamples surface_samples(const Surface& surface, double spacing);

/// How far samples lie from a surface.
struct SampledDistance {
    double largest = 0.0;  ///< [mm]
    double sum = 0.0;      ///< of distance x area [mm^3]
    double area = 0.0;     ///< [mm^2]

    void add(double distance, double sample_area);

    [[nodiscard]] double mean() const { return area > 0.0 ? sum / area : 0.0; }
};

[[nodiscard]] SampledDistance sampled_distance(const SurfaceSamples& samples,
                                               const SurfaceDistance& to);

}  // namespace vesselbench
