#include "smoothing/brush/geodesic_neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A vertex is visited again only if its distance shrinks by this fraction: rounding alone must not
/// send the search in circles.
constexpr double kWorthwhile = 1e-9;

/// How far beyond the radius the search goes at most, in radii, where edges are long.
constexpr double kMargin = 0.5;

/// An edge j-k, and the distances of the place from its ends.
struct Edge {
    double to_j, to_k;  ///< distances of the place [mm]
    double length;      ///< of the edge [mm]
};

/// Distance of corner i of a triangle, through its edge j-k: the place lies in the triangle's
/// plane, beyond that edge; infinite if the straight path does not cross the edge.
double unfolded_distance(const Edge& edge, double ij, double ik) {
    const double e = edge.length;
    const auto along = [&](double from_j, double from_k) {
        return (from_j * from_j - from_k * from_k + e * e) / (2.0 * e);
    };
    const auto beside = [](double from_j, double x) {
        return std::sqrt(std::max(0.0, from_j * from_j - x * x));
    };
    if (!(e > 0.0) || std::abs(edge.to_j - edge.to_k) > e) return kFar;
    const double place_x = along(edge.to_j, edge.to_k), place_y = beside(edge.to_j, place_x);
    const double corner_x = along(ij, ik), corner_y = beside(ij, corner_x);
    const double height = place_y + corner_y;
    if (!(height > 0.0)) return kFar;
    const double crossing = place_x + (corner_x - place_x) * (place_y / height);
    if (crossing < 0.0 || crossing > e) return kFar;
    return std::hypot(corner_x - place_x, height);
}

}  // namespace

GeodesicNeighbourhood::GeodesicNeighbourhood(const Topology& topology)
    : topology_(topology),
      distance_(topology.vertex_count(), 0.0),
      stamp_(topology.vertex_count(), 0) {
    (void)topology.triangles_at();  // built here, so that the first search does not wait for it
}

void GeodesicNeighbourhood::begin() {
    if (++now_ == 0) {  // the counter wrapped around
        std::fill(stamp_.begin(), stamp_.end(), 0U);
        now_ = 1;
    }
    heap_.clear();
    met_.clear();
    found_.clear();
    longest_ = 0.0;
}

double GeodesicNeighbourhood::distance_of(VertexId v) const {
    return stamp_[v] == now_ ? distance_[v] : kFar;
}

void GeodesicNeighbourhood::lower(VertexId v, double distance) {
    if (!std::isfinite(distance)) return;
    if (stamp_[v] != now_) {
        stamp_[v] = now_;
        met_.push_back(v);
    } else if (!(distance < distance_[v] * (1.0 - kWorthwhile))) {
        return;
    }
    distance_[v] = distance;
    heap_.push_back({distance, v});
    std::push_heap(heap_.begin(), heap_.end());
}

void GeodesicNeighbourhood::spread(const Positions& positions, VertexId v) {
    const double own = distance_[v];
    for (const TriangleId t : topology_.triangles_at().row(v)) {
        const Triangle& corners = topology_.triangles()[t];
        const std::size_t at = static_cast<std::size_t>(
            std::find(corners.begin(), corners.end(), v) - corners.begin());
        const VertexId a = corners[(at + 1) % 3], b = corners[(at + 2) % 3];
        const double va = (positions[a] - positions[v]).norm();
        const double vb = (positions[b] - positions[v]).norm();
        const double ab = (positions[b] - positions[a]).norm();
        if (!std::isfinite(va + vb + ab)) continue;
        longest_ = std::max({longest_, va, vb});
        lower(a, std::min(own + va, unfolded_distance({own, distance_of(b), vb}, va, ab)));
        lower(b, std::min(own + vb, unfolded_distance({own, distance_of(a), va}, vb, ab)));
    }
}

std::span<const GeodesicNeighbour> GeodesicNeighbourhood::within(const Positions& positions,
                                                                 TriangleId triangle,
                                                                 const Vec3& point, double radius) {
    require_positive("radius", radius);
    if (positions.size() != topology_.vertex_count())
        throw InvalidInput("got " + std::to_string(positions.size()) + " positions for " +
                           std::to_string(topology_.vertex_count()) + " vertices");
    if (triangle >= topology_.triangle_count())
        throw InvalidInput("triangle " + std::to_string(triangle) + " does not exist");
    if (!point.allFinite()) throw InvalidInput("point is not finite");
    begin();
    for (const VertexId v : topology_.triangles()[triangle])
        lower(v, (positions[v] - point).norm());
    // A path to a vertex within the radius may pass a corner that lies beyond it.
    while (!heap_.empty() &&
           heap_.front().distance <= radius + std::min(longest_, kMargin * radius)) {
        const Waiting nearest = heap_.front();
        std::pop_heap(heap_.begin(), heap_.end());
        heap_.pop_back();
        if (nearest.distance == distance_[nearest.vertex]) spread(positions, nearest.vertex);
    }
    std::sort(met_.begin(), met_.end());
    for (const VertexId v : met_)
        if (distance_[v] <= radius) found_.push_back({v, distance_[v]});
    return found_;
}

}  // namespace vesselbench
