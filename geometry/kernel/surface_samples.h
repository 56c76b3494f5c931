#pragma once

#include <functional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

/// Points that represent a surface instead of its triangles.
struct SurfaceSamples {
    Positions points;                   ///< all vertices first, which represent no area
    std::vector<double> areas;          ///< area that each point represents [mm^2]
    std::vector<TriangleId> triangles;  ///< the triangle that contains each point
};

/// Number of parts per triangle edge, so that the centres of the triangle's n^2 equal parts are at
/// most the spacing apart: 1 to 24, so that a giant triangle does not cost minutes.
/// \param longest edge [mm]
/// \param spacing [mm]; 0 if all edges are
[[nodiscard]] int sample_parts(double longest, double spacing);

/// Calls visit(u, v) for the centres a + u (b - a) + v (c - a) of the n^2 equal parts of a
/// triangle.
template <class Visit>
void for_each_part(int n, const Visit& visit) {
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            visit((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
            if (i + j + 1 < n) visit((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
        }
}

/// All vertices, and the centres of sample_parts()^2 parts of every triangle.
/// \param spacing [mm], > 0
[[nodiscard]] SurfaceSamples surface_samples(const Surface& surface, double spacing);

/// Distance of samples from a surface.
struct SampledDistance {
    double largest = 0.0;  ///< [mm]
    double sum = 0.0;      ///< of distance x area [mm^3]
    double area = 0.0;     ///< [mm^2]

    void add(double distance, double sample_area);

    [[nodiscard]] double mean() const { return area > 0.0 ? sum / area : 0.0; }
};

/// Calls visit(i, closest point of sample i) in order. The searches run in parallel, in blocks that
/// a cancel waits for.
/// \throw Cancelled if the user cancels
void for_each_closest(const SurfaceSamples& samples, const SurfaceDistance& to,
                      const std::function<void(std::size_t, const SurfacePoint&)>& visit,
                      const Progress& progress);

/// \throw Cancelled if the user cancels
[[nodiscard]] SampledDistance sampled_distance(const SurfaceSamples& samples,
                                               const SurfaceDistance& to,
                                               const Progress& progress = {});

}  // namespace vesselbench
