#include "geometry/kernel/surface_gap.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

/// A squared length below this is that of a point [mm^2].
constexpr double kPoint = 1e-24;

double clamped(double share) {
    return std::clamp(share, 0.0, 1.0);
}

SurfaceGap turned(const SurfaceGap& gap) {
    return {gap.to, gap.from, gap.distance};
}

void keep_smaller(SurfaceGap& best, const SurfaceGap& other) {
    if (other.distance < best.distance) best = other;
}

/// A surface, its tree, and the distances of its vertices from the other one.
struct Side {
    const Surface& surface;
    SurfaceDistance distance;
    std::vector<SurfacePoint> nearest;  ///< of the other surface, #V
};

void add_vertices(const Side& side, SurfaceGap& best) {
    for (const Triangle& triangle : side.surface.triangles())
        for (const VertexId v : triangle)  // not all points need be of a triangle
            keep_smaller(
                best, {side.surface.points()[v], side.nearest[v].point, side.nearest[v].distance});
}

std::array<std::array<Vec3, 2>, 3> edges_of(const Surface& surface, const Triangle& triangle) {
    const auto corner = [&](std::size_t k) { return surface.points()[triangle[k % 3]]; };
    return {{{corner(0), corner(1)}, {corner(1), corner(2)}, {corner(2), corner(0)}}};
}

/// Edges that go through the other surface: there is no gap.
void add_crossings(const Side& side, const Triangle& triangle, const SurfaceDistance& other,
                   SurfaceGap& best) {
    for (const auto& [from, to] : edges_of(side.surface, triangle)) {
        const Vec3 along = to - from;
        if (along.squaredNorm() < kPoint) continue;
        if (const auto hit = other.first_hit(from, along, along.norm()))
            keep_smaller(best, {hit->point, hit->point, 0.0});
    }
}

void add_edges(const Side& side, const Triangle& triangle, const Side& other, SurfaceGap& best) {
    const auto own = edges_of(side.surface, triangle);
    const Vec3 centre = (own[0][0] + own[1][0] + own[2][0]) / 3.0;
    double reach = 0.0;
    for (const auto& edge : own) reach = std::max(reach, (edge[0] - centre).norm());
    for (const TriangleId t : other.distance.triangles_within(centre, reach + best.distance))
        for (const auto& theirs : edges_of(other.surface, other.surface.triangles()[t]))
            for (const auto& mine : own)
                keep_smaller(best, segment_gap(mine[0], mine[1], theirs[0], theirs[1]));
}

/// The triangles of a side that may be nearer to the other one than their vertices are.
template <class Visit>
void each_candidate(const Side& side, const SurfaceGap& best, const Visit& visit) {
    for (const Triangle& triangle : side.surface.triangles()) {
        if (best.distance <= 0.0) return;
        double nearest = std::numeric_limits<double>::infinity();
        for (const VertexId v : triangle) nearest = std::min(nearest, side.nearest[v].distance);
        if (nearest - longest_edge(side.surface.points(), triangle) < best.distance)
            visit(triangle);
    }
}

}  // namespace

SurfaceGap segment_gap(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
    const Vec3 u = a1 - a0, v = b1 - b0, between = a0 - b0;
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
    const double ur = u.dot(between), vr = v.dot(between);
    double s = 0.0, t = 0.0;
    if (uu < kPoint) {
        t = vv < kPoint ? 0.0 : clamped(vr / vv);
    } else if (vv < kPoint) {
        s = clamped(-ur / uu);
    } else {
        const double det = uu * vv - uv * uv;
        s = det > 0.0 ? clamped((uv * vr - ur * vv) / det) : 0.0;
        t = (uv * s + vr) / vv;
        if (t < 0.0 || t > 1.0) {
            t = clamped(t);
            s = clamped((uv * t - ur) / uu);
        }
    }
    const Vec3 from = a0 + s * u, to = b0 + t * v;
    return {from, to, (from - to).norm()};
}

SurfaceGap smallest_gap(const Surface& first, const Surface& second) {
    Side one{first, distance_to(first), {}}, two{second, distance_to(second), {}};
    one.nearest = two.distance.closest_points(first.points());
    two.nearest = one.distance.closest_points(second.points());
    SurfaceGap best{.distance = std::numeric_limits<double>::infinity()};
    SurfaceGap back = best;
    add_vertices(one, best);
    add_vertices(two, back);
    keep_smaller(best, turned(back));
    each_candidate(one, best, [&](const Triangle& triangle) {
        add_crossings(one, triangle, two.distance, best);
        add_edges(one, triangle, two, best);
    });
    each_candidate(two, best, [&](const Triangle& triangle) {
        add_crossings(two, triangle, one.distance, best);
    });
    return best;
}

}  // namespace vesselbench
