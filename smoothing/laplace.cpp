#include "smoothing/laplace.h"

#include <string>
#include <utility>

#include "geometry/errors.h"

namespace vesselbench {

Positions laplace(const Topology& topology, const Positions& positions,
                  std::span<const double> weights, const LaplaceParameters& parameters) {
    if (!(parameters.lambda >= 0.0 && parameters.lambda <= 1.0))
        throw InvalidInput("lambda = " + std::to_string(parameters.lambda) + " is not in [0, 1]");
    if (parameters.iterations < 0) throw InvalidInput("iterations must not be negative");
    if (!weights.empty() && weights.size() != positions.size())
        throw InvalidInput("got " + std::to_string(weights.size()) + " weights for " +
                           std::to_string(positions.size()) + " vertices");
    const CompressedRows& rings = topology.rings();
    Positions now = positions, next = positions;
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
        for (std::size_t v = 0; v < now.size(); ++v) {
            const auto ring = rings.row(v);
            if (ring.empty()) continue;
            Vec3 sum = Vec3::Zero();
            for (const VertexId u : ring) sum += now[u];
            const double weight = weights.empty() ? 1.0 : weights[v];
            const Vec3 umbrella = sum / static_cast<double>(ring.size()) - now[v];
            next[v] = now[v] + weight * parameters.lambda * umbrella;
        }
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
