#pragma once

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Gives equal points (bit for bit, -0 = +0) one number, in the order of their first appearance.
class PointWelder {
public:
    explicit PointWelder(std::size_t expected_points = 0);

    VertexId add(const Vec3& point);

    [[nodiscard]] const Positions& points() const { return points_; }

    [[nodiscard]] Positions take() { return std::move(points_); }

private:
    void grow();

    Positions points_;
    std::vector<VertexId> slots_;  ///< open addressing; the size is a power of two
};

}  // namespace vesselbench
