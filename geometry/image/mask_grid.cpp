#include "geometry/image/mask_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/image/lines.h"
#include "geometry/image/squared_distances.h"
#include "geometry/image/voxels.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

/// Indices of one grid as those of another: index = axes * other + first.
struct GridMap {
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Vec3 first = Vec3::Zero();

    [[nodiscard]] Vec3 at(const Vec3& other) const { return axes * other + first; }
};

/// Indices of `from` as those of `to`.
GridMap map_between(const Image& from, const Image& to) {
    const Vec3 first = to.to_index(from.to_patient(Vec3::Zero()));
    GridMap map{.first = first};
    for (Eigen::Index a = 0; a < 3; ++a)
        map.axes.col(a) = to.to_index(from.to_patient(Vec3::Unit(a))) - first;
    return map;
}

Vec3 corner_of(const Image& image, int corner) {
    return {corner & 1 ? image.size[0] - 1.0 : 0.0, corner & 2 ? image.size[1] - 1.0 : 0.0,
            corner & 4 ? image.size[2] - 1.0 : 0.0};
}

/// The map in whole numbers, if both grids are of one lattice; headers are rounded.
std::optional<GridMap> lattice_map(const Image& mask, const Image& image) {
    constexpr double kSamePlace = 0.1;  // voxels
    const GridMap exact = map_between(mask, image);
    const GridMap whole{exact.axes.array().round().matrix(), exact.first.array().round().matrix()};
    if (!(whole.axes.transpose() * whole.axes).isIdentity(1e-9)) return std::nullopt;
    for (int c = 0; c < 8; ++c) {
        const Vec3 corner = corner_of(mask, c);
        if ((exact.at(corner) - whole.at(corner)).cwiseAbs().maxCoeff() > kSamePlace)
            return std::nullopt;
    }
    return whole;
}

VoxelIndex rounded(const Vec3& at) {
    return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
            static_cast<int>(std::lround(at.z()))};
}

template <class Visit>
void for_each_inside(const Image& mask, const Visit& visit) {
    for (int k = 0; k < mask.size[2]; ++k)
        for (int j = 0; j < mask.size[1]; ++j)
            for (int i = 0; i < mask.size[0]; ++i)
                if (const float value = mask.at(i, j, k); value > 0.0f) visit(i, j, k, value);
}

/// Fraction of the mask's inside that a map takes out of the image.
double share_beyond(const Image& image, const Image& mask, const GridMap& map) {
    std::size_t all = 0, lost = 0;
    for_each_inside(mask, [&](int i, int j, int k, float) {
        ++all;
        if (!holds(image, rounded(map.at(Vec3(i, j, k))))) ++lost;
    });
    return all == 0 ? 0.0 : static_cast<double>(lost) / static_cast<double>(all);
}

Image moved(const Image& image, const Image& mask, const GridMap& map) {
    std::vector<float> voxels(image.voxel_count());
    for_each_inside(mask, [&](int i, int j, int k, float value) {
        const VoxelIndex at = rounded(map.at(Vec3(i, j, k)));
        if (holds(image, at)) voxels[image.offset(at[0], at[1], at[2])] = value;
    });
    return with_voxels(image, std::move(voxels));
}

/// A label's signed distances [mm] to its outline, positive inside, in its box and around it.
struct LabelField {
    VoxelIndex first = {0, 0, 0};  ///< mask index of its first value
    Image distances;

    /// At a mask index; far outside beyond the box.
    [[nodiscard]] float at(const Vec3& mask_index) const {
        const Vec3 in(mask_index.x() - first[0], mask_index.y() - first[1],
                      mask_index.z() - first[2]);
        VoxelIndex low{};
        Vec3 t;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<Eigen::Index>(a);
            low[a] = static_cast<int>(std::floor(in[axis]));
            t[axis] = in[axis] - low[a];
            if (low[a] < 0 || low[a] + 1 >= distances.size[a]) return -kFarSquared;
        }
        return static_cast<float>(between_voxels(distances, low, t));
    }
};

/// Distances [mm] to the nearest voxel that is, or is not, inside.
std::vector<float> distances_to(const Image& box, const std::vector<char>& inside, bool wanted) {
    std::vector<float> d(inside.size());
    for (std::size_t v = 0; v < d.size(); ++v)
        d[v] = (inside[v] != 0) == wanted ? 0.0f : kFarSquared;
    const Vec3 spacing = box.spacing();
    for (int axis = 0; axis < 3; ++axis)
        for_each_line(d, box.size, axis, [h = spacing[axis]](std::vector<float>& line) {
            squared_distances(line, h);
        });
    for (float& v : d) v = std::sqrt(v);
    return d;
}

/// Around the box of a label, so that its outline lies within.
constexpr int kMargin = 2;

LabelField field_of(const Image& mask, float label, const VoxelIndex& low, const VoxelIndex& high) {
    LabelField field;
    field.distances.index_to_patient = mask.index_to_patient;
    for (std::size_t a = 0; a < 3; ++a) {
        field.first[a] = low[a] - kMargin;
        field.distances.size[a] = high[a] - low[a] + 1 + 2 * kMargin;
    }
    std::vector<char> inside(field.distances.voxel_count());
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
                inside[field.distances.offset(i - field.first[0], j - field.first[1],
                                              k - field.first[2])] = mask.at(i, j, k) == label;
    std::vector<float> values = distances_to(field.distances, inside, false);
    const std::vector<float> outside = distances_to(field.distances, inside, true);
    for (std::size_t v = 0; v < values.size(); ++v) values[v] -= outside[v];
    field.distances = with_voxels(field.distances, std::move(values));
    return field;
}

/// The image indices that may lie in a box of mask indices.
std::pair<VoxelIndex, VoxelIndex> image_box(const Image& image, const GridMap& to_image,
                                            const VoxelIndex& low, const VoxelIndex& high) {
    Vec3 least = Vec3::Constant(1e9), most = Vec3::Constant(-1e9);
    for (int c = 0; c < 8; ++c) {
        const Vec3 corner(c & 1 ? high[0] + 1 : low[0] - 1, c & 2 ? high[1] + 1 : low[1] - 1,
                          c & 4 ? high[2] + 1 : low[2] - 1);
        least = least.cwiseMin(to_image.at(corner));
        most = most.cwiseMax(to_image.at(corner));
    }
    VoxelIndex first{}, last{};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        first[a] = static_cast<int>(std::clamp(std::floor(least[axis]), 0.0, image.size[a] - 1.0));
        last[a] = static_cast<int>(std::clamp(std::ceil(most[axis]), -1.0, image.size[a] - 1.0));
    }
    return {first, last};
}

/// What is known of a label's voxels before they are resampled.
struct LabelExtent {
    VoxelBox box;            ///< of mask indices
    std::size_t within = 0;  ///< voxels whose centres lie in the image
};

std::map<float, LabelExtent> extents_of(const Image& image, const Image& mask,
                                        const GridMap& to_image) {
    std::map<float, LabelExtent> extents;
    for_each_inside(mask, [&](int i, int j, int k, float value) {
        LabelExtent& extent = extents[value];
        extent.box.add({i, j, k});
        if (holds(image, rounded(to_image.at(Vec3(i, j, k))))) ++extent.within;
    });
    return extents;
}

/// Image voxels near a label, with their depths in it [mm].
struct Depths {
    std::vector<std::size_t> voxels;
    std::vector<float> depths;
};

Depths depths_in(const Image& image, const LabelField& field, const GridMap& to_mask,
                 const std::pair<VoxelIndex, VoxelIndex>& box, float reach) {
    const auto& [first, last] = box;
    const auto slices = static_cast<std::size_t>(std::max(0, last[2] - first[2] + 1));
    std::vector<Depths> by_slice(slices);
    for_each_vertex(slices, [&, first = first, last = last](std::size_t s) {
        const int k = first[2] + static_cast<int>(s);
        for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0]; i <= last[0]; ++i) {
                const float depth = field.at(to_mask.at(Vec3(i, j, k)));
                if (depth <= -reach) continue;
                by_slice[s].voxels.push_back(image.offset(i, j, k));
                by_slice[s].depths.push_back(depth);
            }
    });
    Depths all;
    for (const Depths& one : by_slice) {
        all.voxels.insert(all.voxels.end(), one.voxels.begin(), one.voxels.end());
        all.depths.insert(all.depths.end(), one.depths.begin(), one.depths.end());
    }
    return all;
}

/// The depth beyond which there are so many voxels: distances cut off what is convex. Within
/// `reach`; 0 if the voxels do not suffice.
float fair_depth(std::vector<float> depths, double count, float reach) {
    if (!(count >= 1.0) || count >= static_cast<double>(depths.size())) return 0.0f;
    const auto at = depths.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(depths.begin(), at, depths.end(), std::greater<>());
    return std::clamp(*at, -reach, reach);
}

Image resampled(const Image& image, const Image& mask) {
    const GridMap to_mask = map_between(image, mask), to_image = map_between(mask, image);
    const auto reach = static_cast<float>(0.5 * mask.spacing().minCoeff());
    const double ratio = mask.spacing().prod() / image.spacing().prod();
    std::vector<float> voxels(image.voxel_count()), deepest(image.voxel_count());
    for (const auto& [label, extent] : extents_of(image, mask, to_image)) {
        const VoxelIndex &low = extent.box.low, &high = extent.box.high;
        const LabelField field = field_of(mask, label, low, high);
        const Depths near =
            depths_in(image, field, to_mask, image_box(image, to_image, low, high), reach);
        const float level =
            fair_depth(near.depths, ratio * static_cast<double>(extent.within), reach);
        for (std::size_t n = 0; n < near.voxels.size(); ++n) {
            const std::size_t v = near.voxels[n];
            const float depth = near.depths[n] - level;
            if (depth <= deepest[v]) continue;
            deepest[v] = depth;
            voxels[v] = label;
        }
    }
    return with_voxels(image, std::move(voxels));
}

}  // namespace

PlacedMask mask_on_grid(const Image& image, const Image& mask) {
    const std::optional<GridMap> lattice = lattice_map(mask, image);
    PlacedMask placed;
    if (lattice && mask.size == image.size && lattice->axes.isIdentity() &&
        lattice->first.isZero()) {
        placed.mask = mask;
        placed.mask.index_to_patient = image.index_to_patient;
        return placed;
    }
    placed.grid = lattice ? MaskGrid::Lattice : MaskGrid::Resampled;
    placed.beyond = share_beyond(image, mask, lattice ? *lattice : map_between(mask, image));
    constexpr double kAll = 1.0;
    if (placed.beyond >= kAll)
        throw InvalidInput(
            "the mask lies beside the image: none of its inside is in it; give the mask made on "
            "this image (3D Slicer: Segmentations, Export to files, with the image as reference "
            "volume)");
    placed.mask = lattice ? moved(image, mask, *lattice) : resampled(image, mask);
    return placed;
}

}  // namespace vesselbench
