#include "geometry/image/voxel_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/image/voxels.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr int kMostLayers = 8;

constexpr std::array<VoxelIndex, VoxelBand::kNeighbours> kOffsets = {{{1, 0, 0},
                                                                      {-1, 0, 0},
                                                                      {0, 1, 0},
                                                                      {0, -1, 0},
                                                                      {0, 0, 1},
                                                                      {0, 0, -1},
                                                                      {1, 1, 0},
                                                                      {-1, -1, 0},
                                                                      {1, 0, 1},
                                                                      {-1, 0, -1},
                                                                      {0, 1, 1},
                                                                      {0, -1, -1}}};

/// Calls visit(offset in the image, voxels from `at`) for the voxels at most `reach` away along
/// each axis.
template <class Visit>
void for_each_around(const Image& mask, const VoxelIndex& at, int reach, const Visit& visit) {
    VoxelIndex low = at, high = at;
    for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::max(0, at[a] - reach);
        high[a] = std::min(mask.size[a] - 1, at[a] + reach);
    }
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
                visit(mask.offset(i, j, k), VoxelIndex{i - at[0], j - at[1], k - at[2]});
}

bool at_outline(const Image& mask, std::size_t voxel) {
    const VoxelIndex at = index_of(mask, voxel);
    const bool inside = is_inside((*mask.voxels)[voxel]);
    for (std::size_t n = 0; n < 6; ++n) {
        const VoxelIndex next = {at[0] + kOffsets[n][0], at[1] + kOffsets[n][1],
                                 at[2] + kOffsets[n][2]};
        if (holds(mask, next) && is_inside(mask.at(next[0], next[1], next[2])) != inside)
            return true;
    }
    return false;
}

/// Per voxel of the image 0, or its layer.
std::vector<std::uint8_t> layers_of(const Image& mask, int layers) {
    std::vector<std::uint8_t> layer(mask.voxel_count(), 0);
    for_each_vertex(layer.size(), [&](std::size_t v) { layer[v] = at_outline(mask, v) ? 1 : 0; });
    std::vector<std::size_t> last;
    for (std::size_t v = 0; v < layer.size(); ++v)
        if (layer[v] != 0) last.push_back(v);
    for (int n = 2; n <= layers; ++n) {
        std::vector<std::size_t> next;
        for (const std::size_t v : last)
            for_each_around(mask, index_of(mask, v), 1, [&](std::size_t w, const VoxelIndex&) {
                if (layer[w] != 0) return;
                layer[w] = static_cast<std::uint8_t>(n);
                next.push_back(w);
            });
        last = std::move(next);
    }
    return layer;
}

/// A voxel of layer n is at most n - 1 voxels from one of layer 1 on its own side: on the way to
/// the other side it meets one.
float depth_of(const Image& mask, const std::vector<std::uint8_t>& layer, std::size_t voxel) {
    const bool inside = is_inside((*mask.voxels)[voxel]);
    const Vec3 spacing = mask.spacing();
    double nearest = std::numeric_limits<double>::infinity();
    for_each_around(mask, index_of(mask, voxel), layer[voxel] - 1,
                    [&](std::size_t w, const VoxelIndex& off) {
                        if (layer[w] != 1 || is_inside((*mask.voxels)[w]) != inside) return;
                        const Vec3 step(off[0], off[1], off[2]);
                        nearest = std::min(nearest, step.cwiseProduct(spacing).squaredNorm());
                    });
    return static_cast<float>(std::sqrt(nearest));
}

std::int32_t place_of(const std::vector<std::size_t>& voxels, std::size_t voxel) {
    const auto found = std::lower_bound(voxels.begin(), voxels.end(), voxel);
    return found != voxels.end() && *found == voxel
               ? static_cast<std::int32_t>(found - voxels.begin())
               : VoxelBand::kNone;
}

}  // namespace

bool is_thin(const VoxelBand& band, std::size_t voxel) {
    return std::ranges::none_of(band.neighbours[voxel], [&](std::int32_t place) {
        const auto n = static_cast<std::size_t>(place);
        return place >= 0 && band.inside[n] == band.inside[voxel] && band.layer[n] > 1;
    });
}

VoxelBand voxel_band(const Image& mask, int layers) {
    if (layers < 1 || layers > kMostLayers)
        throw InvalidInput("a band of voxels has 1 to 8 layers, not " + std::to_string(layers));
    const std::vector<std::uint8_t> layer = layers_of(mask, layers);
    VoxelBand band;
    for (std::size_t v = 0; v < layer.size(); ++v)
        if (layer[v] != 0) band.voxels.push_back(v);
    if (band.voxels.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw DiagnosedInput(
            {.code = "mask-outline-too-large", .remedies = {{.operation = "crop"}}});
    band.inside.resize(band.size());
    band.layer.resize(band.size());
    band.depth.resize(band.size());
    band.neighbours.resize(band.size());
    for_each_vertex(band.size(), [&](std::size_t b) {
        const std::size_t voxel = band.voxels[b];
        band.inside[b] = is_inside((*mask.voxels)[voxel]) ? 1 : 0;
        band.layer[b] = layer[voxel];
        band.depth[b] = depth_of(mask, layer, voxel);
        const VoxelIndex at = index_of(mask, voxel);
        for (std::size_t n = 0; n < VoxelBand::kNeighbours; ++n) {
            const VoxelIndex next = {at[0] + kOffsets[n][0], at[1] + kOffsets[n][1],
                                     at[2] + kOffsets[n][2]};
            const bool there =
                holds(mask, next) && layer[mask.offset(next[0], next[1], next[2])] != 0;
            band.neighbours[b][n] =
                there ? place_of(band.voxels, mask.offset(next[0], next[1], next[2]))
                      : VoxelBand::kNone;
        }
    });
    return band;
}

}  // namespace vesselbench
