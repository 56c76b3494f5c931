#include "smoothing/filters/filter_settings.h"

#include <string>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"

namespace vesselbench {

namespace {

void require_length(const char* what, std::size_t length, std::size_t vertices) {
    if (length == vertices) return;
    throw InvalidInput("got " + std::to_string(length) + " " + what + " for " +
                       std::to_string(vertices) + " vertices");
}

void require_fitting(const Topology& topology, const Positions& positions,
                     const FilterSettings& settings) {
    const std::size_t count = topology.vertex_count();
    if (settings.iterations < 0)
        throw InvalidInput("iterations = " + std::to_string(settings.iterations) +
                           " must not be negative");
    if (settings.rings != 1 && settings.rings != 2)
        throw InvalidInput("rings = " + std::to_string(settings.rings) + " is neither 1 nor 2");
    require_length("positions", positions.size(), count);
    if (!settings.weights.empty()) require_length("weights", settings.weights.size(), count);
    if (!settings.fixed.empty()) require_length("fixed flags", settings.fixed.size(), count);
    for (const double weight : settings.weights) require_range("weight", weight, 0.0, 1.0);
    require_finite(positions);
    if (settings.constraint) require_valid(*settings.constraint);
    if (!settings.earlier) return;
    if (settings.earlier->start == nullptr || settings.earlier->iterations < 0)
        throw InvalidInput(
            "an earlier run needs start positions and an iteration count of 0 or more");
    require_length("start positions", settings.earlier->start->size(), count);
}

}  // namespace

void require_one_ring(const char* filter, const FilterSettings& settings) {
    if (settings.rings > 1)
        throw InvalidInput("rings = " + std::to_string(settings.rings) + ": " + filter +
                           " works on one ring only, as its weights belong to edges");
}

std::vector<std::uint8_t> checked_fixed_vertices(const Topology& topology,
                                                 const Positions& positions,
                                                 const FilterSettings& settings) {
    require_fitting(topology, positions, settings);
    std::vector<std::uint8_t> fixed(topology.vertex_count(), 0);
    if (!settings.fixed.empty()) fixed.assign(settings.fixed.begin(), settings.fixed.end());
    if (settings.keep_boundary) {
        const auto& boundary = topology.boundary_vertices();
        for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] |= boundary[v];
    }
    return fixed;
}

}  // namespace vesselbench
