#include "smoothing/taubin.h"

#include <cmath>
#include <sstream>

#include "geometry/errors.h"
#include "smoothing/filter_support.h"

namespace vesselbench {

namespace {

void require_parameters(const TaubinParameters& parameters) {
    detail::require_range("lambda", parameters.lambda, 0.0, 1.0);
    const double mu = parameters.used_mu();
    if (mu <= -parameters.lambda && std::isfinite(mu)) return;
    std::ostringstream text;
    text << "mu = " << mu << " must be at most -lambda = " << -parameters.lambda
         << " (mu is negative: it undoes the shrinking of lambda)";
    throw InvalidInput(text.str());
}

}  // namespace

Positions taubin(const Topology& topology, const Positions& positions,
                 std::span<const double> weights, const TaubinParameters& parameters,
                 const Progress& progress) {
    require_parameters(parameters);
    detail::require_filter_input(topology, positions, weights, parameters.iterations);
    const auto fixed = detail::fixed_vertices(topology, parameters.fixed, parameters.keep_boundary);
    const CompressedRows& rings = topology.rings();
    const double lambda = parameters.lambda, mu = parameters.used_mu();
    Positions now = positions, shrunk = positions;
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
        progress.report(static_cast<double>(iteration) / parameters.iterations, "smoothing");
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (!fixed[v]) shrunk[v] = now[v] + lambda * detail::umbrella(rings, now, v);  // (3.7)
        });
        detail::for_each_vertex(now.size(), [&](std::size_t v) {
            if (fixed[v]) return;
            const Vec3 inflated = shrunk[v] + mu * detail::umbrella(rings, shrunk, v);  // (3.8)
            const double weight = weights.empty() ? 1.0 : weights[v];
            now[v] += weight * (inflated - now[v]);  // (5.1) on the pair's displacement
        });
    }
    return now;
}

bool amplifies(const TaubinParameters& parameters) {
    const double highest = 2.0;
    return std::abs((1.0 - parameters.lambda * highest) * (1.0 - parameters.used_mu() * highest)) >
           1.0;
}

}  // namespace vesselbench
