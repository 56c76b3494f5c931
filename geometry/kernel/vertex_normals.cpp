#include "geometry/kernel/vertex_normals.h"

#include <cmath>
#include <numbers>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/surface_key.h"

namespace vesselbench {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Calls visit(v, triangle) for the triangles at each vertex, ascending; different vertices in
/// parallel. A degenerate triangle may come twice.
template <class Visit>
void visit_triangles_by_vertex(const Surface& surface, const Visit& visit) {
    const CompressedRows& rows = surface.topology->triangles_at();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.vertex_count(), 1024),
                      [&](const auto& range) {
                          for (std::size_t v = range.begin(); v != range.end(); ++v)
                              for (const TriangleId t : rows.row(v))
                                  visit(static_cast<VertexId>(v), t);
                      });
}

}  // namespace

Positions vertex_normals(const Surface& surface) {
    const Positions& points = surface.points();
    Positions normals(points.size(), Vec3::Zero());
    visit_triangles_by_vertex(surface, [&](VertexId v, TriangleId triangle) {
        const Triangle& t = surface.triangles()[triangle];
        const std::size_t k = corner_of(t, v);
        const Vec3 normal = area_normal(points, t);
        const double length = normal.norm();
        if (!(length > 0.0)) return;
        const Vec3 to_next = points[t[(k + 1) % 3]] - points[v],
                   to_previous = points[t[(k + 2) % 3]] - points[v];
        normals[v] += std::atan2(length, to_next.dot(to_previous)) / length * normal;
    });
    // Less is the rounding remainder of coincident triangles: no normal.
    constexpr double kLeastAngle = 1e-9;
    for (Vec3& n : normals) n = n.norm() > kLeastAngle ? n.normalized() : Vec3::Zero();
    return normals;
}

std::shared_ptr<const Positions> vertex_normals_of(const Surface& surface, DerivedCache& cache) {
    if (surface.empty()) return std::make_shared<const Positions>(vertex_normals(surface));
    return cache.find_or_make<Positions>(
        "vertex normals", shape_key(surface, cache), [&] { return vertex_normals(surface); },
        [](const Positions& normals) { return std::as_bytes(std::span(normals)).size(); });
}

std::vector<double> normal_curvature(const Surface& surface, DerivedCache& cache) {
    const std::shared_ptr<const Positions> shared = vertex_normals_of(surface, cache);
    const Positions& normals = *shared;
    // The least cosine identifies the triangle; most angles are not computed.
    std::vector<double> least_cosines(normals.size(), 2.0), largest(normals.size(), 0.0);
    Positions steepest(normals.size(), Vec3::Zero());
    visit_triangles_by_vertex(surface, [&](VertexId v, TriangleId t) {
        const Vec3 normal = area_normal(surface.points(), surface.triangles()[t]);
        const double length = normal.norm();
        if (!(length > 0.0)) return;
        const double cosine = normals[v].dot(normal) / length;
        if (cosine >= least_cosines[v]) return;
        least_cosines[v] = cosine;
        steepest[v] = normal;
    });
    for_each_vertex(normals.size(), [&](std::size_t v) {
        if (least_cosines[v] < 2.0) largest[v] = kDegrees * angle_between(normals[v], steepest[v]);
    });
    return largest;
}

}  // namespace vesselbench
