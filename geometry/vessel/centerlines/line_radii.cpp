#include "geometry/vessel/centerlines/line_radii.h"

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

/// The segments of all lines, as triangles without area: so that the surface's search tree finds
/// the nearest.
struct Segments {
    Positions points;
    std::vector<double> radii;      ///< at the points [mm]
    std::vector<double> abscissas;  ///< of the points, along their branch [mm]
    std::vector<Triangle> list;
    std::vector<std::size_t> branches;  ///< of each segment
};

Segments segments_of(const CenterlineGraph& graph) {
    Segments all;
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const CenterlineBranch& branch = graph.branches[b];
        const auto first = static_cast<VertexId>(all.points.size());
        const std::vector<double> along = abscissas(branch);
        all.points.insert(all.points.end(), branch.points.begin(), branch.points.end());
        all.radii.insert(all.radii.end(), branch.radii.begin(), branch.radii.end());
        all.abscissas.insert(all.abscissas.end(), along.begin(), along.end());
        for (VertexId i = first; i + 1 < all.points.size(); ++i) {
            all.list.push_back({i, i + 1, i + 1});
            all.branches.push_back(b);
        }
    }
    return all;
}

/// The nearest place, and where it lies between the two points of its segment.
struct OnSegment {
    std::size_t segment = 0;
    double share = 0.0;  ///< from its first point [-]
};

std::vector<OnSegment> nearest_on(const Segments& segments, std::span<const Vec3> positions) {
    std::vector<OnSegment> found;
    if (segments.list.empty()) return found;
    for (const SurfacePoint& nearest :
         SurfaceDistance(segments.points, segments.list).closest_points(positions)) {
        const auto& [from, to, again] = segments.list[nearest.triangle];
        const double length = (segments.points[to] - segments.points[from]).norm();
        found.push_back(
            {nearest.triangle,
             length > 0.0 ? (nearest.point - segments.points[from]).norm() / length : 0.0});
    }
    return found;
}

double between(const std::vector<double>& values, const Triangle& segment, double share) {
    return values[segment[0]] + share * (values[segment[1]] - values[segment[0]]);
}

}  // namespace

std::vector<BranchPlace> places_on_nearest_lines(const CenterlineGraph& graph,
                                                 std::span<const Vec3> positions) {
    const Segments segments = segments_of(graph);
    std::vector<BranchPlace> places;
    for (const auto& [segment, share] : nearest_on(segments, positions))
        places.push_back({segments.branches[segment],
                          between(segments.abscissas, segments.list[segment], share)});
    return places;
}

std::vector<double> radii_of_nearest_lines(const CenterlineGraph& graph,
                                           std::span<const Vec3> positions) {
    const Segments segments = segments_of(graph);
    std::vector<double> radii;
    for (const auto& [segment, share] : nearest_on(segments, positions))
        radii.push_back(between(segments.radii, segments.list[segment], share));
    return radii;
}

}  // namespace vesselbench
