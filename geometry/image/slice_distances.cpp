#include "geometry/image/slice_distances.h"

#include <cmath>

#include "geometry/image/lines.h"
#include "geometry/image/squared_distances.h"

namespace vesselbench {

namespace {

/// Distance [mm] within each slice to the nearest voxel where inside == wanted; kFarSquared if
/// none.
std::vector<float> slice_distances(const Image& mask, std::size_t stack, bool wanted) {
    std::vector<float> d(mask.voxels->size());
    for (std::size_t v = 0; v < d.size(); ++v)
        d[v] = ((*mask.voxels)[v] >= 0.5f) == wanted ? 0.0f : kFarSquared;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis != stack) {
            const double h = mask.spacing()[static_cast<Eigen::Index>(axis)];
            for_each_line(d, mask.size, static_cast<int>(axis),
                          [h](std::vector<float>& line) { squared_distances(line, h); });
        }
    for (float& v : d) v = v >= kFarSquared ? kFarSquared : std::sqrt(v);
    return d;
}

}  // namespace

std::vector<float> signed_slice_distances(const Image& mask, std::size_t stack) {
    const auto outside = slice_distances(mask, stack, false);
    const auto inside = slice_distances(mask, stack, true);
    std::vector<float> signed_distance(outside.size());
    for (std::size_t v = 0; v < outside.size(); ++v)
        signed_distance[v] = outside[v] >= kFarSquared  ? kFarSquared
                             : inside[v] >= kFarSquared ? -kFarSquared
                                                        : outside[v] - inside[v];
    return signed_distance;
}

}  // namespace vesselbench
