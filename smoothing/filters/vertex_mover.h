#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "smoothing/filters/filter_settings.h"

namespace vesselbench {

/// Limits the displacement a filter computes for a vertex: fixed vertices stay, weights scale it
/// (Eq. 5.1), then the position constraint clamps it.
class VertexMover {
public:
    /// Keeps references to its arguments. \throw InvalidInput as checked_fixed_vertices
    VertexMover(const Topology& topology, const Positions& positions,
                const FilterSettings& settings);

    /// True if the vertex cannot move.
    [[nodiscard]] bool stays(std::size_t v) const {
        return fixed_[v] != 0 || (!settings_.weights.empty() && settings_.weights[v] == 0.0);
    }

    /// Position after a displacement from `now`; not for fixed vertices.
    [[nodiscard]] Vec3 moved(std::size_t v, const Vec3& now, const Vec3& displacement) const;

private:
    const Positions& start_;
    const FilterSettings& settings_;
    std::vector<std::uint8_t> fixed_;
};

}  // namespace vesselbench
