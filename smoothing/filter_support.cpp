#include "smoothing/filter_support.h"

#include <sstream>

#include "geometry/errors.h"

namespace vesselbench::detail {

FixedVertices fixed_vertices(const Topology& topology, std::span<const std::uint8_t> fixed,
                             bool keep_boundary) {
    const std::size_t count = topology.vertex_count();
    if (!fixed.empty() && fixed.size() != count)
        throw InvalidInput("got " + std::to_string(fixed.size()) + " fixed flags for " +
                           std::to_string(count) + " vertices");
    FixedVertices result{std::vector<std::uint8_t>(count, 0)};
    if (!fixed.empty()) result.flags.assign(fixed.begin(), fixed.end());
    if (keep_boundary)
        for (std::size_t v = 0; v < count; ++v) result.flags[v] |= topology.boundary_vertices()[v];
    return result;
}

void require_range(const char* name, double value, double minimum, double maximum) {
    if (value >= minimum && value <= maximum) return;
    std::ostringstream text;
    text << name << " = " << value << " is not in [" << minimum << ", " << maximum << "]";
    throw InvalidInput(text.str());
}

void require_filter_input(const Topology& topology, const Positions& positions,
                          std::span<const double> weights, int iterations) {
    if (iterations < 0)
        throw InvalidInput("iterations = " + std::to_string(iterations) + " must not be negative");
    if (positions.size() != topology.vertex_count())
        throw InvalidInput("got " + std::to_string(positions.size()) + " positions for " +
                           std::to_string(topology.vertex_count()) + " vertices");
    if (!weights.empty() && weights.size() != positions.size())
        throw InvalidInput("got " + std::to_string(weights.size()) + " weights for " +
                           std::to_string(positions.size()) + " vertices");
    for (const double weight : weights) require_range("weight", weight, 0.0, 1.0);
}

}  // namespace vesselbench::detail
