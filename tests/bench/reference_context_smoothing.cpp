#include "tests/bench/reference_context_smoothing.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace vesselbench::bench {

namespace {

constexpr double kShrink = 0.5, kInflate = -0.53;  ///< factors of the umbrella vector

/// Orientation to each axis: 0 for a face across it, 1 for a face along it. #T
std::vector<Vec3> orientations(const Surface& surface, const Eigen::Matrix3d& axes) {
    const Positions& x = surface.points();
    std::vector<Vec3> found;
    for (const Triangle& t : surface.triangles()) {
        const Vec3 normal = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).normalized();
        found.emplace_back(Vec3::Ones() - (axes.transpose() * normal).cwiseAbs());
    }
    return found;
}

/// Vertices around which the orientation to one of the axes changes by the angle or more.
std::vector<VertexId> staircase_vertices(const Surface& surface, const Eigen::Matrix3d& axes,
                                         double angle) {
    const std::vector<Vec3> of_face = orientations(surface, axes);
    std::vector<Vec3> low(surface.vertex_count(), Vec3::Constant(2.0)),
        high(surface.vertex_count(), Vec3::Constant(-1.0));
    for (std::size_t f = 0; f < of_face.size(); ++f)
        for (const VertexId v : surface.triangles()[f]) {
            low[v] = low[v].cwiseMin(of_face[f]);
            high[v] = high[v].cwiseMax(of_face[f]);
        }
    std::vector<VertexId> found;
    for (VertexId v = 0; v < surface.vertex_count(); ++v)
        if ((high[v] - low[v]).maxCoeff() >= angle) found.push_back(v);
    return found;
}

Positions umbrella_step(const Surface& surface, const Positions& x,
                        const std::vector<double>& weights, double factor) {
    const auto& rings = surface.topology->rings();
    Positions moved = x;
    for (VertexId v = 0; v < surface.vertex_count(); ++v) {
        const auto ring = rings.row(v);
        if (ring.empty()) continue;
        Vec3 sum = Vec3::Zero();
        for (const VertexId u : ring) sum += x[u] - x[v];
        moved[v] += weights[v] * factor / static_cast<double>(ring.size()) * sum;
    }
    return moved;
}

}  // namespace

std::vector<double> context_weights(const Surface& surface, const Eigen::Matrix3d& axes,
                                    const ContextSmoothing& parameters) {
    const Positions& x = surface.points();
    const auto& rings = surface.topology->rings();
    std::vector<double> weights(x.size(), parameters.min_weight);
    std::vector<VertexId> seen_from(x.size(), static_cast<VertexId>(x.size()));  // by no search
    for (const VertexId s : staircase_vertices(surface, axes, parameters.angle)) {
        std::deque<VertexId> queue = {s};
        seen_from[s] = s;
        for (; !queue.empty(); queue.pop_front()) {
            const VertexId v = queue.front();
            const double near = 1.0 - (x[v] - x[s]).norm() / parameters.max_distance;
            weights[v] =
                std::max(weights[v], near * (1.0 - parameters.min_weight) + parameters.min_weight);
            for (const VertexId u : rings.row(v)) {
                if (seen_from[u] == s || (x[u] - x[s]).norm() > parameters.max_distance) continue;
                seen_from[u] = s;
                queue.push_back(u);
            }
        }
    }
    return weights;
}

Positions context_smoothed(const Surface& surface, const std::vector<double>& weights, int steps) {
    Positions x = surface.points();
    for (int i = 0; i < steps; ++i)
        for (const double factor : {kShrink, kInflate})
            x = umbrella_step(surface, x, weights, factor);
    return x;
}

}  // namespace vesselbench::bench
