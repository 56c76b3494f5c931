#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/topology.h"
#include "geometry/vec3.h"

namespace vesselbench::detail {

/// Which vertices a filter leaves alone: bit for bit, and in every intermediate state of an
/// iteration too, so that their neighbours see them as they are.
struct FixedVertices {
    std::vector<std::uint8_t> flags;  ///< #V

    [[nodiscard]] bool operator[](std::size_t v) const { return flags[v] != 0; }
};

/// The vertices of `fixed` and, with keep_boundary, the boundary vertices of an open surface.
/// \throw InvalidInput if `fixed` is neither empty nor #V long
[[nodiscard]] FixedVertices fixed_vertices(const Topology& topology,
                                           std::span<const std::uint8_t> fixed, bool keep_boundary);

/// \throw InvalidInput unless minimum <= value <= maximum; the text names the parameter
void require_range(const char* name, double value, double minimum, double maximum);

/// \throw InvalidInput unless positions are #V long, weights empty or #V long, iterations >= 0
void require_filter_input(const Topology& topology, const Positions& positions,
                          std::span<const double> weights, int iterations);

/// Uniform umbrella operator 1/|N(v)| sum_{u in N(v)} (x_u - x_v) at one vertex; zero without
/// neighbours. Neighbours are added in ascending order, so that the bits do not depend on threads.
[[nodiscard]] inline Vec3 umbrella(const CompressedRows& rings, const Positions& x, std::size_t v) {
    const auto ring = rings.row(v);
    if (ring.empty()) return Vec3::Zero();
    Vec3 sum = Vec3::Zero();
    for (const VertexId u : ring) sum += x[u];
    return sum / static_cast<double>(ring.size()) - x[v];
}

/// Calls move(v) for every vertex, on all threads; move may write to element v only.
template <class Move>
void for_each_vertex(std::size_t count, const Move& move) {
    constexpr std::size_t kGrain = 2048;  // about 50 microseconds of work
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
        for (std::size_t v = range.begin(); v != range.end(); ++v) move(v);
    });
}

}  // namespace vesselbench::detail
