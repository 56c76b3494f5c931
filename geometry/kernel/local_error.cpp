#include "geometry/kernel/local_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void require_length(const char* what, std::size_t length, const Topology& topology) {
    if (length == topology.vertex_count()) return;
    throw InvalidInput("got " + std::to_string(length) + " " + what + " for " +
                       std::to_string(topology.vertex_count()) + " vertices");
}

void require_input(const Topology& topology, const Positions& original, const Positions& moved,
                   const std::vector<VertexId>& references) {
    require_length("original positions", original.size(), topology);
    require_length("moved positions", moved.size(), topology);
    require_length("references", references.size(), topology);
    for (std::size_t v = 0; v < references.size(); ++v)
        if (references[v] >= topology.vertex_count())
            throw InvalidInput("the reference of vertex " + std::to_string(v) + " is vertex " +
                               std::to_string(references[v]) + ", but there are only " +
                               std::to_string(topology.vertex_count()));
}

/// The vertex that p drifts to from `reference`. Every step comes strictly closer, so the loop
/// ends.
VertexId drift(const CompressedRows& rings, const Positions& original, const Vec3& p,
               VertexId reference) {
    double closest = (p - original[reference]).squaredNorm();
    if (std::isnan(closest)) closest = kInfinity;
    for (VertexId from = reference;; from = reference) {
        for (const VertexId u : rings.row(from)) {
            const double squared = (p - original[u]).squaredNorm();
            if (!(squared < closest)) continue;
            closest = squared;
            reference = u;
        }
        if (reference == from) return reference;
    }
}

/// The original surface and its neighbour arrays.
struct Original {
    const CompressedRows& triangles_at;
    std::span<const Triangle> triangles;
    const Positions& points;
};

/// The point of a ring that is closest to a given point.
struct RingPlace {
    double squared = kInfinity;  ///< distance [mm^2]; infinite without a triangle of finite corners
    bool outer = false;          ///< on the ring's outer edge
    VertexId ends[2] = {0, 0};   ///< of that edge
};

RingPlace closest_in_ring(const Original& original, const Vec3& p, VertexId centre) {
    constexpr double kOnEdge =
        1e-9;  // height over the outer edge relative to the triangle's height [-]
    RingPlace place;
    for (const TriangleId t : original.triangles_at.row(centre)) {
        const Triangle& corners = original.triangles[t];
        const auto [a, b, c] = corners;
        const Vec3 q = closest_point_on_triangle(p, original.points[a], original.points[b],
                                                 original.points[c]);
        const double squared = (p - q).squaredNorm();
        if (!(squared < place.squared)) continue;
        const int at = b == centre ? 1 : c == centre ? 2 : 0;
        const VertexId u = corners[(at + 1) % 3], w = corners[(at + 2) % 3];
        const Vec3 edge = original.points[w] - original.points[u];
        const double height = edge.cross(q - original.points[u]).norm();
        const double full = edge.cross(original.points[centre] - original.points[u]).norm();
        place = {squared, height <= kOnEdge * full, {u, w}};
    }
    return place;
}

/// Infinite without a triangle of finite corners. If the closest point is on the ring's outer edge,
/// the surface beyond may be closer: the ring then moves there. Every step comes strictly closer,
/// so the loop ends.
double distance_to_triangles(const Original& original, const Vec3& p, VertexId reference) {
    RingPlace best = closest_in_ring(original, p, reference);
    for (bool closer = best.outer; closer;) {
        closer = false;
        const RingPlace from = best;
        for (const VertexId end : from.ends) {
            const RingPlace next = closest_in_ring(original, p, end);
            if (!(next.squared < best.squared)) continue;
            best = next;
            closer = best.outer;
        }
    }
    return std::sqrt(best.squared);
}

/// Eq. 6.2: the third component of Eq. 6.1 is the distance from the triangle's plane, because its
/// third column is a unit normal. Infinite without a triangle that has a normal.
double distance_to_planes(const Original& original, const Vec3& p, VertexId reference) {
    double largest = -kInfinity;
    for (const TriangleId t : original.triangles_at.row(reference)) {
        const Vec3 normal = area_normal(original.points, original.triangles[t]);
        const double length = normal.norm();
        if (!(length > 0.0) || !std::isfinite(length)) continue;
        largest = std::max(largest, std::abs(normal.dot(p - original.points[reference])) / length);
    }
    return largest < 0.0 ? kInfinity : largest;
}

double vertex_error(const Original& original, const Vec3& p, VertexId reference,
                    LocalErrorForm form) {
    if (!p.allFinite()) return 0.0;
    const double distance = form == LocalErrorForm::Thesis
                                ? distance_to_planes(original, p, reference)
                                : distance_to_triangles(original, p, reference);
    if (std::isfinite(distance)) return distance;
    const double from_reference = (p - original.points[reference]).norm();
    return std::isfinite(from_reference) ? from_reference : 0.0;
}

}  // namespace

std::vector<VertexId> own_references(const Topology& topology) {
    std::vector<VertexId> references(topology.vertex_count());
    std::iota(references.begin(), references.end(), VertexId{0});
    return references;
}

void follow_drift(const Topology& topology, const Positions& original, const Positions& moved,
                  std::vector<VertexId>& references) {
    require_input(topology, original, moved, references);
    const CompressedRows& rings = topology.rings();
    tbb::parallel_for(std::size_t{0}, moved.size(), [&](std::size_t v) {
        references[v] = drift(rings, original, moved[v], references[v]);
    });
}

LocalError local_error(const Topology& topology, const Positions& original, const Positions& moved,
                       const std::vector<VertexId>& references, LocalErrorForm form) {
    require_input(topology, original, moved, references);
    LocalError error;
    error.values.resize(moved.size());
    const Original surface{topology.triangles_at(), topology.triangles(), original};
    tbb::parallel_for(std::size_t{0}, moved.size(), [&](std::size_t v) {
        error.values[v] = vertex_error(surface, moved[v], references[v], form);
    });
    for (const double value : error.values) {  // in order: the same bits every time
        error.mean += value;
        error.largest = std::max(error.largest, value);
    }
    if (!error.values.empty()) error.mean /= static_cast<double>(error.values.size());
    return error;
}

VertexId drifted_reference(const Topology& topology, const Positions& original, const Vec3& p,
                           VertexId reference) {
    return drift(topology.rings(), original, p, reference);
}

double local_error_at(const Topology& topology, const Positions& original, const Vec3& p,
                      VertexId reference, LocalErrorForm form) {
    return vertex_error({topology.triangles_at(), topology.triangles(), original}, p, reference,
                        form);
}

LocalError local_error(const Topology& topology, const Positions& original, const Positions& moved,
                       LocalErrorForm form) {
    std::vector<VertexId> references = own_references(topology);
    follow_drift(topology, original, moved, references);
    return local_error(topology, original, moved, references, form);
}

}  // namespace vesselbench
