#include "geometry/kernel/mean_curvature.h"

#include <cmath>

#include "geometry/kernel/surface_key.h"
#include "geometry/kernel/vertex_normals.h"

namespace vesselbench {

namespace {

/// Adds a triangle's contribution to the curvature normals 2 H n A = 1/2 sum (cot + cot)(x_i - x_j)
/// (Meyer et al., Eq. 8) and to the mixed areas (Eq. 7 and Figure 4).
void add_triangle(const Positions& points, const Triangle& t, Positions& normals,
                  std::vector<double>& areas) {
    const double doubled = area_normal(points, t).norm();
    if (!(doubled > 0.0)) return;
    Vec3 edge[3];  // edge[k] is opposite to corner k
    double cot[3];
    for (int k = 0; k < 3; ++k) edge[k] = points[t[(k + 2) % 3]] - points[t[(k + 1) % 3]];
    for (int k = 0; k < 3; ++k) cot[k] = -edge[(k + 1) % 3].dot(edge[(k + 2) % 3]) / doubled;
    const bool obtuse = cot[0] < 0.0 || cot[1] < 0.0 || cot[2] < 0.0;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        normals[t[next]] -= 0.5 * cot[k] * edge[k];
        normals[t[last]] += 0.5 * cot[k] * edge[k];
        if (obtuse)
            areas[t[k]] += doubled / (cot[k] < 0.0 ? 4.0 : 8.0);
        else
            areas[t[k]] +=
                (edge[next].squaredNorm() * cot[next] + edge[last].squaredNorm() * cot[last]) / 8.0;
    }
}

/// \param outward unit normals that give the sign, #V
MeanCurvature signed_curvature(const Surface& surface, const Positions& outward) {
    Positions normals(surface.vertex_count(), Vec3::Zero());
    MeanCurvature result;
    result.areas.assign(surface.vertex_count(), 0.0);
    for (const Triangle& t : surface.triangles())
        add_triangle(surface.points(), t, normals, result.areas);
    const auto& rim = surface.topology->boundary_vertices();
    result.values.assign(surface.vertex_count(), 0.0);
    for (std::size_t v = 0; v < normals.size(); ++v) {
        if (rim[v] || !(result.areas[v] > 0.0)) continue;
        const double size = normals[v].norm() / (2.0 * result.areas[v]);
        result.values[v] = normals[v].dot(outward[v]) < 0.0 ? -size : size;
    }
    return result;
}

}  // namespace

MeanCurvature mean_curvature(const Surface& surface) {
    return signed_curvature(surface, vertex_normals(surface));
}

std::shared_ptr<const MeanCurvature> mean_curvature_of(const Surface& surface,
                                                       DerivedCache& cache) {
    return cache.find_or_make<MeanCurvature>(
        "mean curvature", shape_key(surface, cache),
        [&] { return signed_curvature(surface, *vertex_normals_of(surface, cache)); },
        [](const MeanCurvature& made) {
            return std::as_bytes(std::span(made.values)).size() +
                   std::as_bytes(std::span(made.areas)).size();
        });
}

}  // namespace vesselbench
