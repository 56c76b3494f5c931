#include "geometry/image/coarse_image.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

namespace vesselbench {

namespace {

constexpr int kLeastVoxels = 2;  ///< along an axis of an image that has a surface

int coarse_count(int count, int step) {
    return (count + step - 1) / step;
}

std::array<int, 3> coarse_size(const Image& image, const VoxelSteps& steps) {
    std::array<int, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        size[axis] = coarse_count(image.size[axis], steps[axis]);
    return size;
}

/// The axis with the shortest voxels of those that can have fewer; -1: none can.
int axis_to_coarsen(const Image& image, const VoxelSteps& steps) {
    const Vec3 spacing = image.spacing();
    int best = -1;
    double shortest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (coarse_count(image.size[a], steps[a] + 1) < kLeastVoxels) continue;
        const double edge = spacing[axis] * steps[a];
        if (best >= 0 && edge >= shortest) continue;
        best = axis;
        shortest = edge;
    }
    return best;
}

/// One coarse voxel's block; at the image's border, the last voxels count again.
template <class Join>
float joined(const Image& image, const VoxelSteps& steps, const std::array<int, 3>& at, float start,
             const Join& join) {
    float value = start;
    for (int k = 0; k < steps[2]; ++k)
        for (int j = 0; j < steps[1]; ++j)
            for (int i = 0; i < steps[0]; ++i)
                value = join(value, image.at(std::min(at[0] * steps[0] + i, image.size[0] - 1),
                                             std::min(at[1] * steps[1] + j, image.size[1] - 1),
                                             std::min(at[2] * steps[2] + k, image.size[2] - 1)));
    return value;
}

template <class Value>
Image coarse(const Image& image, const VoxelSteps& steps, const Value& value) {
    Image result{.size = coarse_size(image, steps), .index_to_patient = image.index_to_patient};
    Eigen::Matrix4d blocks = Eigen::Matrix4d::Identity();
    for (int axis = 0; axis < 3; ++axis) {
        const int step = steps[static_cast<std::size_t>(axis)];
        blocks(axis, axis) = step;
        blocks(axis, 3) = 0.5 * (step - 1);
    }
    result.index_to_patient = image.index_to_patient * blocks;
    std::vector<float> voxels(result.voxel_count());
    tbb::parallel_for(0, result.size[2], [&](int k) {
        for (int j = 0; j < result.size[1]; ++j)
            for (int i = 0; i < result.size[0]; ++i)
                voxels[result.offset(i, j, k)] = value(std::array<int, 3>{i, j, k});
    });
    result.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result;
}

}  // namespace

VoxelSteps coarse_steps(const Image& image, std::size_t most_voxels) {
    VoxelSteps steps = {1, 1, 1};
    for (Image size = image; size.voxel_count() > most_voxels;
         size.size = coarse_size(image, steps)) {
        const int axis = axis_to_coarsen(image, steps);
        if (axis < 0) break;
        ++steps[static_cast<std::size_t>(axis)];
    }
    return steps;
}

Image coarse_image(const Image& image, const VoxelSteps& steps) {
    const float share = 1.0F / static_cast<float>(steps[0] * steps[1] * steps[2]);
    return coarse(image, steps, [&](const std::array<int, 3>& at) {
        return share * joined(image, steps, at, 0.0F, [](float a, float b) { return a + b; });
    });
}

Image coarse_mask(const Image& mask, const VoxelSteps& steps) {
    return coarse(mask, steps, [&](const std::array<int, 3>& at) {
        return joined(mask, steps, at, 0.0F, [](float a, float b) { return std::max(a, b); });
    });
}

}  // namespace vesselbench
