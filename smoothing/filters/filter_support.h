#pragma once

#include <cstdint>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/filter_settings.h"

namespace vesselbench::detail {

/// \throw InvalidInput unless minimum <= value <= maximum; the text names the parameter
void require_range(const char* name, double value, double minimum, double maximum);

/// \throw InvalidInput unless the value is positive and finite; the text names the parameter
void require_positive(const char* name, double value);

/// \throw InvalidInput if the settings ask for more than one ring
void require_one_ring(const char* filter, const FilterSettings& settings);

/// 1 where a filter leaves a vertex alone: the fixed ones and, with keep_boundary, those on the
/// boundary of an open surface; #V.
/// \throw InvalidInput if the settings do not fit the topology, or a position is not finite
[[nodiscard]] std::vector<std::uint8_t> checked_fixed_vertices(const Topology& topology,
                                                               const Positions& positions,
                                                               const FilterSettings& settings);

/// Positions before the first iteration: those given, or where the earlier run began.
[[nodiscard]] inline const Positions& start_of(const Positions& positions,
                                               const FilterSettings& settings) {
    return settings.earlier ? *settings.earlier->start : positions;
}

/// Neighbours of every vertex within two rings, without itself, each row ascending.
[[nodiscard]] CompressedRows two_rings(const Topology& topology);

/// What becomes of the displacement that a filter wants for a vertex: fixed vertices stay, weights
/// scale it (Eq. 5.1), then the position constraint clamps it.
class VertexMover {
public:
    /// Keeps references to its arguments. \throw InvalidInput as checked_fixed_vertices
    VertexMover(const Topology& topology, const Positions& positions,
                const FilterSettings& settings);

    /// True where nothing can move the vertex.
    [[nodiscard]] bool stays(std::size_t v) const {
        return fixed_[v] != 0 || (!settings_.weights.empty() && settings_.weights[v] == 0.0);
    }

    /// Position after a displacement from `now`; not for vertices that stay.
    [[nodiscard]] Vec3 moved(std::size_t v, const Vec3& now, const Vec3& displacement) const;

private:
    const Positions& start_;
    const FilterSettings& settings_;
    std::vector<std::uint8_t> fixed_;
};

/// Calls move(v) for every vertex, on all threads; move may write to element v only.
template <class Move>
void for_each_vertex(std::size_t count, const Move& move) {
    constexpr std::size_t kGrain = 2048;  // about 50 microseconds of work
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
        for (std::size_t v = range.begin(); v != range.end(); ++v) move(v);
    });
}

}  // namespace vesselbench::detail
