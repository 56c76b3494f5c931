#include "meshing/remeshing/held_resolution.h"

#include <algorithm>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

constexpr double kFinest = 0.35, kLeastChange = 0.8;  // of the edge, at once

/// In proportion, not by the square root that a round wall needs: edges bridge what is narrow.
double shortening(double distance, double resolution) {
    return std::clamp(kLeastChange * resolution / distance, kFinest, kLeastChange);
}

Positions triangle_centres(const Surface& surface) {
    Positions centres;
    centres.reserve(surface.triangle_count());
    const Positions& points = surface.points();
    for (const auto& [a, b, c] : surface.triangles())
        centres.push_back((points[a] + points[b] + points[c]) / 3.0);
    return centres;
}

}  // namespace

LargestDeviation refine_where_off(const Surface& source, const Surface& result, double resolution,
                                  std::vector<double>& sizes, const Progress& cancel) {
    LargestDeviation largest;
    std::vector<double> factors(sizes.size(), 1.0);
    const auto note = [&](VertexId v, double distance, const Vec3& place) {
        if (distance > largest.distance) largest = {distance, place};
        if (distance > resolution)
            factors[v] = std::min(factors[v], shortening(distance, resolution));
    };
    const auto from_source = SurfaceDistance(result).closest_points(source.points());
    for (VertexId v = 0; v < from_source.size(); ++v)
        note(v, from_source[v].distance, source.points()[v]);
    cancel.check_cancelled();
    for (const SurfacePoint& nearest : distance_to(source).closest_points(triangle_centres(result)))
        for (const VertexId v : source.triangles()[nearest.triangle])
            note(v, nearest.distance, nearest.point);
    for (std::size_t v = 0; v < sizes.size(); ++v)
        sizes[v] = std::max(factors[v] * sizes[v], std::min(sizes[v], resolution));
    return largest;
}

}  // namespace vesselbench
