#include "smoothing/cap_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "geometry/box_tree.h"

namespace vesselbench {

namespace {

/// Vertices of the cap that have a triangle outside of it, or lie on a boundary.
std::vector<VertexId> rim_of(const Surface& surface, const Cap& cap) {
    std::unordered_map<VertexId, std::size_t> triangles_inside;
    for (const TriangleId t : cap.triangles)
        for (const VertexId v : surface.triangles()[t]) ++triangles_inside[v];
    std::vector<VertexId> rim;
    for (const VertexId v : cap.vertices)
        if (triangles_inside[v] < surface.topology->triangles_at().row(v).size() ||
            surface.topology->boundary_vertices()[v] != 0)
            rim.push_back(v);
    return rim;
}

/// Distance to the nearest of some vertices [mm].
class NearestVertex {
public:
    NearestVertex(const Positions& points, const std::vector<VertexId>& vertices)
        : points_(points), vertices_(vertices) {
        std::vector<BoxTree::Box> boxes;
        for (const VertexId v : vertices) boxes.emplace_back(points[v]);
        tree_ = BoxTree(boxes);
    }

    [[nodiscard]] double distance(const Vec3& p) const {
        double squared = std::numeric_limits<double>::infinity();
        tree_.traverse(
            [&](const BoxTree::Box& box) { return box.squaredExteriorDistance(p) < squared; },
            [&](std::uint32_t i) {
                squared = std::min(squared, (p - points_[vertices_[i]]).squaredNorm());
            });
        return std::sqrt(squared);
    }

private:
    const Positions& points_;
    const std::vector<VertexId>& vertices_;
    BoxTree tree_;
};

}  // namespace

Positions rounded_caps(const Surface& surface, const std::vector<Cap>& caps) {
    Positions rounded = surface.points();
    for (const Cap& cap : caps) {
        const std::vector<VertexId> rim = rim_of(surface, cap);
        if (rim.empty()) continue;  // a closed flat thing has no inside to dome
        const NearestVertex nearest(surface.points(), rim);
        std::vector<double> depths;
        depths.reserve(cap.vertices.size());
        for (const VertexId v : cap.vertices) depths.push_back(nearest.distance(rounded[v]));
        const double radius = *std::max_element(depths.begin(), depths.end());
        if (!(radius > 0.0)) continue;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            if (depths[i] == 0.0) continue;
            const double outward = 1.0 - depths[i] / radius;
            rounded[cap.vertices[i]] +=
                radius * std::sqrt(std::max(0.0, 1.0 - outward * outward)) * cap.normal;
        }
    }
    return rounded;
}

}  // namespace vesselbench
