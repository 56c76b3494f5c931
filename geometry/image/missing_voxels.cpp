#include "geometry/image/missing_voxels.h"

#include <algorithm>

#include "geometry/image/clean_image.h"
#include "geometry/image/voxel_band.h"

namespace vesselbench {

namespace {

/// A tree of vessels has a loop for thousands of its voxels, one of missing voxels for tens.
constexpr std::int64_t kMostLoops = 100;
constexpr std::int64_t kVoxelsPerLoop = 250;
constexpr int kMostClosing = 3;
constexpr double kIso = 0.5;

std::size_t inside_count(const Image& mask) {
    return static_cast<std::size_t>(std::ranges::count_if(*mask.voxels, is_inside));
}

bool is_full_of_holes(const VoxelTopology& topology, std::size_t inside) {
    const std::int64_t loops = topology.tunnels() + topology.cavities;
    return loops > kMostLoops && loops * kVoxelsPerLoop > static_cast<std::int64_t>(inside);
}

}  // namespace

FilledMask without_missing_voxels(const Image& mask) {
    FilledMask filled;
    filled.mask = mask;
    filled.before = voxel_topology(mask, kIso);
    filled.after = filled.before;
    const std::size_t inside = inside_count(mask);
    if (!is_full_of_holes(filled.before, inside)) return filled;
    for (int radius = 1; radius <= kMostClosing; ++radius) {
        const Image closing = closed(mask, radius);
        const VoxelTopology after = voxel_topology(closing, kIso);
        const std::size_t now = inside_count(closing);
        if (is_full_of_holes(after, now)) continue;
        return {.mask = closing,
                .closing = radius,
                .added = now - std::min(now, inside),
                .before = filled.before,
                .after = after};
    }
    return filled;
}

}  // namespace vesselbench
