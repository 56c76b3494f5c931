#include "meshing/remeshing/surface_walk.h"

#include <algorithm>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr TriangleId kNone = std::numeric_limits<TriangleId>::max();
constexpr int kMostSteps = 32;

/// Barycentric weights of the point of triangle a, b, c nearest to p; exactly zero for the corners
/// opposite to an edge, or away from a corner, that the point lies on.
/// Source: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
Vec3 closest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) {
        const double t = d1 / (d1 - d3);
        return {1.0 - t, t, 0.0};
    }
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) {
        const double t = d2 / (d2 - d6);
        return {1.0 - t, 0.0, t};
    }
    const double va = d3 * d6 - d5 * d4, along_bc = (d4 - d3) + (d5 - d6);
    if (va <= 0.0 && d4 >= d3 && d5 >= d6 && along_bc > 0.0) {
        const double t = (d4 - d3) / along_bc;
        return {0.0, 1.0 - t, t};
    }
    const double sum = va + vb + vc;
    if (sum <= 0.0) return {1.0, 0.0, 0.0};  // a triangle degenerate to a point
    return {1.0 - (vb + vc) / sum, vb / sum, vc / sum};
}

}  // namespace

SurfaceWalk::SurfaceWalk(const Surface& surface)
    : surface_(surface), across_(3 * surface.triangle_count(), kNone) {
    const CompressedRows& fans = surface_.topology->triangles_at();
    const auto triangles = surface_.triangles();
    const PatchLabels& labels = *surface_.patch_labels;
    for_each_vertex(triangles.size(), [&](std::size_t t) {
        for (int i = 0; i < 3; ++i) {
            const VertexId a = triangles[t][i], b = triangles[t][(i + 1) % 3];
            for (const TriangleId s : fans.row(a))
                if (s != t && labels[s] == labels[t] &&
                    std::count(triangles[s].begin(), triangles[s].end(), b) > 0)
                    across_[3 * t + i] = s;
        }
    });
}

SurfaceWalk::Place SurfaceWalk::place_on(TriangleId t, const Vec3& x) const {
    const Positions& points = surface_.points();
    const Triangle& triangle = surface_.triangles()[t];
    const Vec3 &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
    const Vec3 w = closest_weights(x, a, b, c);
    const Vec3 point = w[0] * a + w[1] * b + w[2] * c;
    return {point, w, t, (point - x).squaredNorm()};
}

/// The best place on the triangles around a corner that `at` lies on: those on the way there may be
/// no closer than the corner itself.
SurfaceWalk::Place SurfaceWalk::best_around(const Place& at, int corner, const Vec3& x) const {
    constexpr int kMostTurns = 64;
    const auto triangles = surface_.triangles();
    const VertexId v = triangles[at.triangle][corner];
    Place best = at;
    for (const int side : {0, 2}) {  // the edge that leaves the corner, and the one that enters it
        TriangleId t = across(at.triangle, (corner + side) % 3);
        for (int turn = 0; turn < kMostTurns && t != kNone; ++turn) {
            if (t == at.triangle) return best;  // the whole fan was visited
            const Place place = place_on(t, x);
            if (place.squared < best.squared) best = place;
            t = across(t, (corner_of(triangles[t], v) + side) % 3);
        }
    }
    return best;
}

SurfaceWalk::Place SurfaceWalk::best_beyond(const Place& at, const Vec3& x) const {
    for (int i = 0; i < 3; ++i)
        if (at.weights[(i + 1) % 3] == 0.0 && at.weights[(i + 2) % 3] == 0.0)
            return best_around(at, i, x);
    for (int i = 0; i < 3; ++i) {
        if (at.weights[(i + 2) % 3] != 0.0) continue;
        const TriangleId t = across(at.triangle, i);
        return t == kNone ? at : place_on(t, x);
    }
    return at;
}

SurfaceWalk::Place SurfaceWalk::closest(const Vec3& x, TriangleId from) const {
    constexpr double kGain = 1.0 - 1e-12;  // rounding must not make it walk to and fro
    Place best = place_on(from, x);
    for (int step = 0; step < kMostSteps; ++step) {
        const Place next = best_beyond(best, x);
        if (!(next.squared < kGain * best.squared)) break;
        best = next;
    }
    return best;
}

}  // namespace vesselbench
