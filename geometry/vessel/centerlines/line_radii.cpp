#include "geometry/vessel/centerlines/line_radii.h"

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

std::vector<double> radii_of_nearest_lines(const CenterlineGraph& graph,
                                           std::span<const Vec3> positions) {
    // Segments as triangles without area, so that the surface's search tree finds the nearest.
    Positions points;
    std::vector<double> radii;
    std::vector<Triangle> segments;
    for (const CenterlineBranch& branch : graph.branches) {
        const auto first = static_cast<VertexId>(points.size());
        points.insert(points.end(), branch.points.begin(), branch.points.end());
        radii.insert(radii.end(), branch.radii.begin(), branch.radii.end());
        for (VertexId i = first; i + 1 < points.size(); ++i) segments.push_back({i, i + 1, i + 1});
    }
    const auto nearest = SurfaceDistance(points, segments).closest_points(positions);
    std::vector<double> found(positions.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& [from, to, again] = segments[nearest[i].triangle];
        const double length = (points[to] - points[from]).norm();
        const double share = length > 0.0 ? (nearest[i].point - points[from]).norm() / length : 0.0;
        found[i] = radii[from] + share * (radii[to] - radii[from]);
    }
    return found;
}

}  // namespace vesselbench
