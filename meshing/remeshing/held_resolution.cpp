#include "meshing/remeshing/held_resolution.h"

#include <algorithm>

#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/triangle_shape.h"

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
    for (const Triangle& triangle : surface.triangles())
        centres.push_back(triangle_centre(surface.points(), triangle));
    return centres;
}

}  // namespace

Deviations deviations_from(const Surface& source, const Surface& result, const Progress& cancel) {
    Deviations deviations{.at = std::vector<double>(source.vertex_count(), 0.0)};
    const auto note = [&](VertexId v, double distance, const Vec3& place) {
        deviations.at[v] = std::max(deviations.at[v], distance);
        if (distance > deviations.largest.distance) deviations.largest = {distance, place};
    };
    const auto from_source = SurfaceDistance(result).closest_points(source.points());
    for (VertexId v = 0; v < from_source.size(); ++v)
        note(v, from_source[v].distance, source.points()[v]);
    cancel.check_cancelled();
    for (const SurfacePoint& nearest : distance_to(source).closest_points(triangle_centres(result)))
        for (const VertexId v : source.triangles()[nearest.triangle])
            note(v, nearest.distance, nearest.point);
    return deviations;
}

void shorten_where_off(const Deviations& deviations, double resolution,
                       std::vector<double>& sizes) {
    for (std::size_t v = 0; v < sizes.size(); ++v)
        if (deviations.at[v] > resolution)
            sizes[v] = std::max(shortening(deviations.at[v], resolution) * sizes[v],
                                std::min(sizes[v], resolution));
}

}  // namespace vesselbench
