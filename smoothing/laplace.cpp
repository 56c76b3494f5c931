#include "smoothing/laplace.h"

#include <utility>

#include "smoothing/filter_support.h"

namespace vesselbench {

Positions laplace(const Topology& topology, const Positions& positions,
                  std::span<const double> weights, const LaplaceParameters& parameters,
                  const Progress& progress) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    detail::require_filter_input(topology, positions, weights, parameters.iterations);
    const auto fixed = detail::fixed_vertices(topology, parameters.fixed, parameters.keep_boundary);
    const CompressedRows& rings = topology.rings();
    Positions now = positions, next = positions;
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / parameters.iterations, "smoothing");
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (fixed[v]) return;
            const double weight = weights.empty() ? 1.0 : weights[v];
            next[v] = now[v] + weight * parameters.lambda * detail::umbrella(rings, now, v);
        });
        std::swap(now, next);
    }
    return now;
}

}  // namespace vesselbench
