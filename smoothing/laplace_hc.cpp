#include "smoothing/laplace_hc.h"

#include "smoothing/filter_support.h"

namespace vesselbench {

Positions laplace_hc(const Topology& topology, const Positions& positions,
                     std::span<const double> weights, const LaplaceHcParameters& parameters,
                     const Progress& progress) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    detail::require_range("alpha", parameters.alpha, 0.0, 1.0);
    detail::require_range("beta", parameters.beta, 0.0, 1.0);
    detail::require_filter_input(topology, positions, weights, parameters.iterations);
    const auto fixed = detail::fixed_vertices(topology, parameters.fixed, parameters.keep_boundary);
    const CompressedRows& rings = topology.rings();
    const double lambda = parameters.lambda, alpha = parameters.alpha, beta = parameters.beta;
    const Positions& original = positions;
    Positions now = positions, smoothed = positions;
    Positions back(positions.size(), Vec3::Zero());
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / parameters.iterations, "smoothing");
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (fixed[v]) return;
            smoothed[v] = now[v] + lambda * detail::umbrella(rings, now, v);         // (3.3)
            back[v] = smoothed[v] - (alpha * original[v] + (1.0 - alpha) * now[v]);  // (3.4)
        });
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (fixed[v] || rings.row(v).empty()) return;
            const Vec3 ring_mean = back[v] + detail::umbrella(rings, back, v);
            const Vec3 correction = -beta * back[v] - (1.0 - beta) * ring_mean;  // (3.5)
            const double weight = weights.empty() ? 1.0 : weights[v];
            now[v] += weight * (smoothed[v] + correction - now[v]);  // (3.6), (5.1)
        });
    }
    return now;
}

bool amplifies(const LaplaceHcParameters& parameters) {
    const double highest = 2.0;
    return (1.0 - parameters.beta) * parameters.lambda * highest * highest > 2.0;
}

}  // namespace vesselbench
