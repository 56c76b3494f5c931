#include "smoothing/filters/cotangents.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr double kLargestCotangent = 20.0;  // an angle of 3 degrees

double clamped_cotangent(double dot, double doubled_area) {
    if (doubled_area > 0.0) return std::clamp(dot / doubled_area, 0.0, kLargestCotangent);
    return dot > 0.0 ? kLargestCotangent : 0.0;
}

/// Contribution of one triangle to the operators at its corner v.
struct CornerShare {
    Vec3 flow = Vec3::Zero();  ///< cot (v - u) over both other corners
    Vec3 normal = Vec3::Zero();
    double area = 0.0, angle = 0.0;
};

CornerShare share_of(const Positions& x, const Triangle& t, VertexId v) {
    const std::uint32_t k = corner_of(t, v);
    const Vec3 to_next = x[t[(k + 1) % 3]] - x[v], to_last = x[t[(k + 2) % 3]] - x[v];
    const Vec3 opposite = to_last - to_next;
    CornerShare share;
    share.normal = to_next.cross(to_last);
    const double doubled = share.normal.norm();
    if (!(doubled > 0.0)) return share;
    const double dot = to_next.dot(to_last);
    const double cot_next = -to_next.dot(opposite) / doubled;
    const double cot_last = to_last.dot(opposite) / doubled;
    share.flow = -cot_last * to_next - cot_next * to_last;
    share.angle = std::atan2(doubled, dot);
    if (dot < 0.0)
        share.area = doubled / 4.0;
    else if (cot_next < 0.0 || cot_last < 0.0)
        share.area = doubled / 8.0;
    else
        share.area = (to_next.squaredNorm() * cot_last + to_last.squaredNorm() * cot_next) / 8.0;
    return share;
}

}  // namespace

void find_cotangents(const Topology& topology, const Positions& positions, Cotangents& cotangents) {
    const auto triangles = topology.triangles();
    cotangents.resize(triangles.size());
    for_each_vertex(triangles.size(), [&](std::size_t t) {
        const Vec3 &a = positions[triangles[t][0]], &b = positions[triangles[t][1]],
                   &c = positions[triangles[t][2]];
        const Vec3 ab = b - a, bc = c - b, ca = a - c;
        const double doubled = ab.cross(ca).norm();
        cotangents[t] = {clamped_cotangent(-ab.dot(ca), doubled),
                         clamped_cotangent(-bc.dot(ab), doubled),
                         clamped_cotangent(-ca.dot(bc), doubled)};
    });
}

Vec3 cotangent_umbrella(const Topology& topology, const Positions& positions,
                        const Cotangents& cotangents, VertexId v) {
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    for (const TriangleId t : topology.triangles_at().row(v)) {
        const Triangle& triangle = topology.triangles()[t];
        const std::uint32_t k = corner_of(triangle, v), next = (k + 1) % 3, last = (k + 2) % 3;
        const double to_next = cotangents[t][static_cast<std::size_t>(last)];
        const double to_last = cotangents[t][static_cast<std::size_t>(next)];
        sum += to_next * (positions[triangle[static_cast<std::size_t>(next)]] - positions[v]) +
               to_last * (positions[triangle[static_cast<std::size_t>(last)]] - positions[v]);
        weights += to_next + to_last;
    }
    return weights > 0.0 ? Vec3(sum / weights) : Vec3::Zero();
}

std::vector<VertexCurvature> vertex_curvatures(const Topology& topology,
                                               const Positions& positions) {
    std::vector<VertexCurvature> curvatures(positions.size());
    const auto& boundary = topology.boundary_vertices();
    const CompressedRows& rows = topology.triangles_at();
    for_each_vertex(positions.size(), [&](std::size_t v) {
        if (boundary[v] != 0) return;
        CornerShare all;
        for (const TriangleId t : rows.row(v)) {
            const CornerShare share =
                share_of(positions, topology.triangles()[t], static_cast<VertexId>(v));
            all.flow += share.flow;
            all.normal += share.normal;
            all.area += share.area;
            all.angle += share.angle;
        }
        if (!(all.area > 0.0)) return;
        // flow / (2 A) is 2 H n (Eq. 8)
        const double size = all.flow.norm() / (4.0 * all.area);
        curvatures[v].mean = all.flow.dot(all.normal) < 0.0 ? -size : size;
        curvatures[v].gauss = (2.0 * std::numbers::pi - all.angle) / all.area;
    });
    return curvatures;
}

}  // namespace vesselbench
