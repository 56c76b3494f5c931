#include "smoothing/filters/vertex_mover.h"

namespace vesselbench {

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

}  // namespace vesselbench
