#include "smoothing/filters/filter_support.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"

namespace vesselbench::detail {

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
        throw InvalidInput("an earlier run has start positions and did 0 or more iterations");
    require_length("start positions", settings.earlier->start->size(), count);
}

}  // namespace

void require_range(const char* name, double value, double minimum, double maximum) {
    if (value >= minimum && value <= maximum) return;
    std::ostringstream text;
    text << name << " = " << value << " is not in [" << minimum << ", " << maximum << "]";
    throw InvalidInput(text.str());
}

void require_positive(const char* name, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    std::ostringstream text;
    text << name << " = " << value << " must be positive and finite";
    throw InvalidInput(text.str());
}

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

VertexMover::VertexMover(const Topology& topology, const Positions& positions,
                         const FilterSettings& settings)
    : start_(start_of(positions, settings)),
      settings_(settings),
      fixed_(checked_fixed_vertices(topology, positions, settings)) {}

Vec3 VertexMover::moved(std::size_t v, const Vec3& now, const Vec3& displacement) const {
    const double weight = settings_.weights.empty() ? 1.0 : settings_.weights[v];
    const Vec3 wanted = now + weight * displacement;
    return settings_.constraint ? settings_.constraint->clamped(start_[v], wanted) : wanted;
}

CompressedRows two_rings(const Topology& topology) {
    const CompressedRows& rings = topology.rings();
    CompressedRows wide;
    wide.offsets.assign(1, 0);
    wide.offsets.reserve(topology.vertex_count() + 1);
    std::vector<VertexId> around;
    for (VertexId v = 0; v < topology.vertex_count(); ++v) {
        around.assign(rings.row(v).begin(), rings.row(v).end());
        for (const VertexId u : rings.row(v))
            around.insert(around.end(), rings.row(u).begin(), rings.row(u).end());
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for (const VertexId u : around)
            if (u != v) wide.values.push_back(u);
        wide.offsets.push_back(static_cast<std::uint32_t>(wide.values.size()));
    }
    return wide;
}

}  // namespace vesselbench::detail
