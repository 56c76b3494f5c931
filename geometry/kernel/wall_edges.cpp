#include "geometry/kernel/wall_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/lumen_width.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/triangle_neighbours.h"

namespace vesselbench {

namespace {

bool is_wall(const Surface& surface, TriangleId t) {
    return surface.patch_of(t).kind == PatchKind::Wall;
}

double degrees_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

void add_edge(const Vec3& a, const Vec3& b, WallEdges& edges) {
    const double less = std::min(a.norm(), b.norm()), more = std::max(a.norm(), b.norm());
    if (less == 0.0) return;
    edges.angles.push_back(degrees_between(a, b));
    edges.size_ratios.push_back(std::sqrt(more / less));
}

double mean_edge(const Positions& points, const Triangle& triangle) {
    const Vec3 &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
    return ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3.0;
}

void add_triangle(const Surface& surface, const SurfaceDistance& distance, double farthest,
                  TriangleId t, WallResolution& resolution) {
    const Triangle& triangle = surface.triangles()[t];
    const Vec3 normal = area_normal(surface.points(), triangle);
    if (normal.isZero()) return;
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : triangle) middle += surface.points()[v] / 3.0;
    const auto width = lumen_width(distance, middle, -normal.normalized(), farthest);
    if (!width || *width <= 0.0) return;
    const double edge = mean_edge(surface.points(), triangle);
    resolution.edges_around.push_back(std::numbers::pi * *width / edge);
    resolution.sags.push_back(edge * edge / (4.0 * *width));  // h^2 / (8 r)
    resolution.areas.push_back(0.5 * normal.norm());
}

}  // namespace

std::vector<std::uint8_t> vertices_of_wall(const Surface& surface) {
    std::vector<std::uint8_t> on_wall(surface.vertex_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (is_wall(surface, t))
            for (const VertexId v : surface.triangles()[t]) on_wall[v] = 1;
    return on_wall;
}

WallEdges wall_edges(const Surface& surface) {
    WallEdges edges;
    const auto neighbours = edge_neighbours(surface.triangles());
    for (TriangleId t = 0; t < neighbours.size(); ++t)
        for (const TriangleId other : neighbours[t])
            if (other != kNoTriangle && t < other && is_wall(surface, t) && is_wall(surface, other))
                add_edge(area_normal(surface.points(), surface.triangles()[t]),
                         area_normal(surface.points(), surface.triangles()[other]), edges);
    return edges;
}

WallResolution wall_resolution(const Surface& surface, const SurfaceDistance& distance,
                               std::size_t most) {
    WallResolution resolution;
    const double farthest = bounds(surface).diagonal();
    const std::size_t step = std::max<std::size_t>(1, surface.triangle_count() / most);
    for (std::size_t t = 0; t < surface.triangle_count(); t += step)
        if (const auto id = static_cast<TriangleId>(t); is_wall(surface, id))
            add_triangle(surface, distance, farthest, id, resolution);
    return resolution;
}

}  // namespace vesselbench
