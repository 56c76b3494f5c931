#include "geometry/kernel/space_order.h"

#include <cstdint>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_sort.h>

namespace vesselbench {

namespace {

constexpr int kBits = 21;  // of each coordinate

/// The bits with two zeros after each.
std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x001f00000000ffffULL;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
    bits = (bits | bits << 2) & 0x1249249249249249ULL;
    return bits;
}

}  // namespace

std::vector<VertexId> space_order(const Positions& points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    const double extent = points.empty() ? 0.0 : box.sizes().maxCoeff();
    const double scale = extent > 0.0 ? ((1 << kBits) - 1) / extent : 0.0;
    std::vector<std::pair<std::uint64_t, VertexId>> places(points.size());
    for (VertexId v = 0; v < points.size(); ++v) {
        const Vec3 at = scale * (points[v] - box.min());
        places[v] = {spread(static_cast<std::uint64_t>(at.x())) |
                         spread(static_cast<std::uint64_t>(at.y())) << 1 |
                         spread(static_cast<std::uint64_t>(at.z())) << 2,
                     v};
    }
    tbb::parallel_sort(places.begin(), places.end());
    std::vector<VertexId> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = places[i].second;
    return order;
}

}  // namespace vesselbench
