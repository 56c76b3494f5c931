#include "smoothing/context/distance_weights.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

void require_neighbours(std::span<const Surface> neighbours) {
    if (neighbours.empty())
        throw InvalidInput("distance awareness needs a neighbour, but there is none");
    for (const Surface& neighbour : neighbours)
        if (neighbour.empty())
            throw InvalidInput(
                "distance awareness needs neighbours with triangles, but one has none");
}

bool is_closed(const Surface& neighbour) {
    return std::ranges::none_of(neighbour.topology->boundary_vertices(),
                                [](std::uint8_t boundary) { return boundary != 0; });
}

void require_distance_parameters(const DistanceParameters& parameters) {
    if (!(parameters.margin >= 0.0) || !std::isfinite(parameters.margin))
        throw InvalidInput("margin must be at least 0 mm");
    require_positive("omega", parameters.omega);
}

std::vector<double> neighbour_distances(const Positions& positions,
                                        std::span<const Surface> neighbours) {
    require_neighbours(neighbours);
    std::vector<double> distances(positions.size(), std::numeric_limits<double>::infinity());
    for (const Surface& neighbour : neighbours) {
        const SurfaceDistance surface = distance_to(neighbour);
        const bool closed = is_closed(neighbour);
        for_each_vertex(positions.size(), [&](std::size_t v) {
            const double distance = closed ? std::max(0.0, surface.signed_distance(positions[v]))
                                           : surface.closest_point(positions[v]).distance;
            distances[v] = std::min(distances[v], distance);
        });
    }
    return distances;
}

std::vector<double> distance_weights(std::span<const double> distances,
                                     const DistanceParameters& parameters) {
    require_distance_parameters(parameters);
    for (const double d : distances)
        if (!(d >= 0.0) || !std::isfinite(d))
            throw InvalidInput("distances to neighbours must be finite and not negative");
    std::vector<double> weights(distances.size(), 0.0);
    if (distances.empty()) return weights;
    const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
    const bool margin = parameters.scaling == DistanceScaling::Margin;
    const double from = margin ? parameters.margin : *least, range = *most - from;
    if (!(range > 0.0)) return weights;
    const double omega = parameters.omega;
    for (std::size_t v = 0; v < weights.size(); ++v) {
        const double beyond = std::max(0.0, distances[v] - from);
        // Eq. 5.2 divided by e^(omega max(D)), to avoid overflow.
        weights[v] = parameters.scaling == DistanceScaling::Exponential
                         ? std::exp(omega * (beyond - range)) * -std::expm1(-omega * beyond) /
                               -std::expm1(-omega * range)
                         : beyond / range;
    }
    return weights;
}

}  // namespace vesselbench
