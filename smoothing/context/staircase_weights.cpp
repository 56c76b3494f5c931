#include "smoothing/context/staircase_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/context/connected_distances.h"

namespace vesselbench {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

void require_staircase_parameters(std::size_t vertex_count, const StaircaseParameters& parameters) {
    if (!parameters.caps.empty() && parameters.caps.size() != vertex_count)
        throw InvalidInput("got " + std::to_string(parameters.caps.size()) + " cap flags for " +
                           std::to_string(vertex_count) + " vertices");
    require_range("tau_theta", parameters.tau_theta, 0.0, 1.0);
    require_positive("tau_max", parameters.tau_max);
    require_range("beta_min", parameters.beta_min, 0.0, 1.0);
}

std::vector<double> staircase_distances(const Topology& topology, const Positions& positions,
                                        std::span<const double> change,
                                        const StaircaseParameters& parameters) {
    const std::size_t count = topology.vertex_count();
    if (positions.size() != count || change.size() != count)
        throw InvalidInput("positions and orientation changes must match the " +
                           std::to_string(count) + " vertices");
    require_staircase_parameters(count, parameters);
    std::vector<VertexId> staircases;
    for (VertexId v = 0; v < change.size(); ++v) {
        const bool cap = !parameters.caps.empty() && parameters.caps[v] != 0;
        if (change[v] > parameters.tau_theta && !cap && positions[v].allFinite())
            staircases.push_back(v);
    }
    return connected_distances(topology, positions, staircases, parameters.tau_max);
}

std::vector<double> staircase_weights(const Topology& topology, const Positions& positions,
                                      std::span<const double> change,
                                      const StaircaseParameters& parameters) {
    return weights_of_distances(staircase_distances(topology, positions, change, parameters),
                                parameters);
}

std::vector<double> weights_of_distances(std::vector<double> weights,
                                         const StaircaseParameters& parameters) {
    require_staircase_parameters(weights.size(), parameters);
    double largest = parameters.tau_max;
    if (parameters.scaling == StaircaseScaling::Thesis) {
        largest = 0.0;
        for (const double d : weights)
            if (d != kFar) largest = std::max(largest, d);
    }
    for_each_vertex(weights.size(), [&](std::size_t v) {
        const double d = weights[v];
        const double near = d == kFar ? 0.0 : largest > 0.0 ? 1.0 - d / largest : 1.0;  // (5.5)
        weights[v] = near * (1.0 - parameters.beta_min) + parameters.beta_min;          // (5.6)
        if (!parameters.caps.empty() && parameters.caps[v] != 0) weights[v] = 0.0;
    });
    return weights;
}

}  // namespace vesselbench
