#include "geometry/image/vessel_block.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "geometry/image/clean_image.h"
#include "geometry/image/voxel_topology.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

/// Voxels around the vessel: the widest blur, and as far as the mean along a wall reaches.
constexpr int kMargin = 10;

/// By voxel: 1 in the vessel.
std::vector<std::uint8_t> voxels_of_vessel(const Image& field, double threshold,
                                           const VesselBody& body) {
    const VoxelComponents bodies = voxel_components(field, threshold, Neighbourhood::Faces);
    if (bodies.sizes.empty()) throw AlgorithmFailure("no voxel is inside");
    std::int32_t vessel = 0;
    if (body.seed) {
        const Vec3 index = field.to_index(*body.seed);
        std::array<int, 3> at{};
        for (std::size_t a = 0; a < 3; ++a)
            at[a] = std::clamp(static_cast<int>(std::lround(index[static_cast<Eigen::Index>(a)])),
                               0, field.size[a] - 1);
        vessel = bodies.labels[field.offset(at[0], at[1], at[2])];
    }
    if (vessel == 0)
        vessel = static_cast<std::int32_t>(std::ranges::max_element(bodies.sizes) -
                                           bodies.sizes.begin() + 1);
    std::vector<std::uint8_t> chosen(bodies.labels.size());
    for_each_vertex(chosen.size(), [&](std::size_t v) {
        chosen[v] = (body.all ? bodies.labels[v] != 0 : bodies.labels[v] == vessel) ? 1 : 0;
    });
    return chosen;
}

/// A piece of fewer voxels is noise.
constexpr std::size_t kSmallestPiece = 27;

/// By label of a gap: whether it has two pieces at its faces.
std::vector<bool> connecting(const Image& grid, const VoxelComponents& gaps,
                             const VoxelComponents& pieces) {
    std::vector<std::int32_t> first(gaps.sizes.size() + 1, 0);
    std::vector<bool> connects(gaps.sizes.size() + 1, false);
    const auto touch = [&](std::size_t gap_voxel, std::size_t voxel) {
        const auto gap = static_cast<std::size_t>(gaps.labels[gap_voxel]);
        const std::int32_t piece = pieces.labels[voxel];
        if (gap == 0 || piece == 0 ||
            pieces.sizes[static_cast<std::size_t>(piece - 1)] < kSmallestPiece)
            return;
        if (first[gap] == 0) first[gap] = piece;
        if (first[gap] != piece) connects[gap] = true;
    };
    const auto row = static_cast<std::size_t>(grid.size[0]),
               slice = row * static_cast<std::size_t>(grid.size[1]);
    for (int k = 0; k < grid.size[2]; ++k)
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                const std::size_t v = grid.offset(i, j, k);
                const auto both = [&](bool there, std::size_t next) {
                    if (!there) return;
                    touch(v, next);
                    touch(next, v);
                };
                both(i + 1 < grid.size[0], v + 1);
                both(j + 1 < grid.size[1], v + row);
                both(k + 1 < grid.size[2], v + slice);
            }
    return connects;
}

template <class Row>
void for_rows(const Image& image, const VoxelBlock& block, const Row& row) {
    for (int k = 0; k < block.size[2]; ++k)
        for (int j = 0; j < block.size[1]; ++j)
            row(static_cast<std::ptrdiff_t>(
                image.offset(block.from[0], block.from[1] + j, block.from[2] + k)));
}

/// \param values of the block's voxels \param voxels of the whole grid
void write_part(const Image& grid, const VoxelBlock& block, const std::vector<float>& values,
                std::vector<float>& voxels) {
    auto value = values.begin();
    for_rows(grid, block, [&](std::ptrdiff_t from) {
        std::copy_n(value, block.size[0], voxels.begin() + from);
        value += block.size[0];
    });
}

}  // namespace

VoxelBlock block_around(const Image& image, const VoxelBox& box, int margin) {
    VoxelBlock block{.size = image.size};
    if (box.count == 0) return block;
    for (std::size_t a = 0; a < 3; ++a) {
        block.from[a] = std::max(0, box.low[a] - margin);
        block.size[a] = std::min(image.size[a], box.high[a] + 1 + margin) - block.from[a];
    }
    return block;
}

VoxelBlock block_around_vessel(const Image& image, double threshold, const VesselBody& body) {
    const auto chosen = voxels_of_vessel(image, threshold, body);
    VoxelBox box;
    for (int k = 0; k < image.size[2]; ++k)
        for (int j = 0; j < image.size[1]; ++j)
            for (int i = 0; i < image.size[0]; ++i)
                if (chosen[image.offset(i, j, k)] != 0) box.add({i, j, k});
    return block_around(image, box, kMargin);
}

Image part_of(const Image& image, const VoxelBlock& block) {
    std::vector<float> voxels;
    for_rows(image, block, [&](std::ptrdiff_t from) {
        voxels.insert(voxels.end(), image.voxels->begin() + from,
                      image.voxels->begin() + from + block.size[0]);
    });
    Image part = image;
    part.size = block.size;
    part.index_to_patient.topRightCorner<3, 1>() =
        image.to_patient(Vec3(block.from[0], block.from[1], block.from[2]));
    return with_voxels(std::move(part), std::move(voxels));
}

Image with_part(const Image& image, const VoxelBlock& block, const std::vector<float>& values) {
    std::vector<float> voxels = *image.voxels;
    write_part(image, block, values, voxels);
    return with_voxels(image, std::move(voxels));
}

Image with_part(const Image& grid, const VoxelBlock& block, const std::vector<float>& values,
                float outside) {
    std::vector<float> voxels(grid.voxel_count(), outside);
    write_part(grid, block, values, voxels);
    return with_voxels(grid, std::move(voxels));
}

std::vector<float> around_vessel(const Image& image, double threshold, const VesselBody& body,
                                 int voxels) {
    const auto chosen = voxels_of_vessel(image, threshold, body);
    Image mask = image;
    mask.voxels = std::make_shared<const std::vector<float>>(chosen.begin(), chosen.end());
    return *dilated(mask, voxels).voxels;
}

void keep_vessel(const Image& grid, const VesselBody& body, std::vector<float>& inside) {
    Image field = grid;
    field.voxels = std::make_shared<const std::vector<float>>(inside);
    const auto chosen = voxels_of_vessel(field, 0.0, body);
    constexpr float kOutside = 1e-6f;  // what is on the surface counts as inside
    for_each_vertex(inside.size(), [&](std::size_t v) {
        if (inside[v] >= 0.0f && chosen[v] == 0) inside[v] = -inside[v] - kOutside;
    });
}

std::vector<std::size_t> voxels_of_gaps(const Image& image, double threshold,
                                        const VesselBody& body, const std::vector<float>& inside) {
    const auto whole = voxels_of_vessel(image, threshold, body);
    Image field = image;
    field.voxels = std::make_shared<const std::vector<float>>(inside);
    const VoxelComponents pieces = voxel_components(field, 0.0, Neighbourhood::Faces);
    std::vector<float> lost(inside.size());
    for_each_vertex(lost.size(), [&](std::size_t v) {
        lost[v] = whole[v] != 0 && pieces.labels[v] == 0 ? 1.0f : 0.0f;
    });
    field.voxels = std::make_shared<const std::vector<float>>(std::move(lost));
    const VoxelComponents gaps = voxel_components(field, 0.5, Neighbourhood::Faces);
    const std::vector<bool> connects = connecting(image, gaps, pieces);
    std::vector<std::size_t> voxels;
    for (std::size_t v = 0; v < gaps.labels.size(); ++v)
        if (connects[static_cast<std::size_t>(gaps.labels[v])]) voxels.push_back(v);
    return voxels;
}

}  // namespace vesselbench
