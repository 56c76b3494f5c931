#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "geometry/phantoms/random.h"
#include "tests/forest/dice.h"
#include "tests/forest/model.h"

namespace vesselbench::forest {

namespace {

/// Voxels around the vessels.
constexpr double kMargin = 3.0;
constexpr double kInside = 1000.0;

struct Grid {
    Vec3 origin;
    Eigen::Matrix3d steps;  ///< columns: one voxel along i, j, k [mm]
    Eigen::Array3i size;
};

/// The image's axes are the patient's, or, without a border, turned in a third of the cases.
Eigen::Matrix3d axes_for(const Tree& tree, const Plan& plan) {
    Dice dice(plan.seed ^ 0xa7e5ULL);
    if (tree.border || plan.kind == CaseKind::VoxelSurface || !dice.chance(0.33))
        return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(dice.between(0.1, 0.6), dice.direction()).toRotationMatrix();
}

Grid grid_for(const Tree& tree, const Plan& plan) {
    const Voxels voxels = voxels_for(plan, tree);
    const Vec3 spacing(voxels.pixel, voxels.pixel, voxels.slice);
    const Eigen::Matrix3d axes = axes_for(tree, plan);
    Eigen::AlignedBox3d box;
    for (const Branch& branch : tree.branches)
        for (const LinePoint& p : shaping_line(branch)) {
            box.extend(Vec3(axes.transpose() * p.at - Vec3::Constant(p.radius)));
            box.extend(Vec3(axes.transpose() * p.at + Vec3::Constant(p.radius)));
        }
    for (const Sac& sac : tree.sacs) {
        box.extend(Vec3(axes.transpose() * sac.centre - Vec3::Constant(sac.radius)));
        box.extend(Vec3(axes.transpose() * sac.centre + Vec3::Constant(sac.radius)));
    }
    box.min() -= kMargin * spacing;
    box.max() += kMargin * spacing;
    if (tree.border) {  // the last voxel ends at the border
        Eigen::Index axis = 0;
        const Vec3 normal = tree.border->normal();
        normal.cwiseAbs().maxCoeff(&axis);
        const double at = -tree.border->offset() * normal[axis];
        if (normal[axis] > 0.0)
            box.max()[axis] = at - 0.5 * spacing[axis];
        else
            box.min()[axis] = at + 0.5 * spacing[axis];
        const auto count = std::floor(box.sizes()[axis] / spacing[axis]);
        if (normal[axis] > 0.0) box.min()[axis] = box.max()[axis] - count * spacing[axis];
    }
    const Eigen::Array3i size =
        (box.sizes().array() / spacing.array() + 1e-9).floor().cast<int>() + 1;
    return {axes * box.min(), axes * spacing.asDiagonal(), size};
}

/// Contours drawn slightly off, slice by slice.
std::vector<double> jitter_of(const Plan& plan, int slices, double pixel) {
    Dice dice(plan.seed ^ 0x317eULL);
    std::vector<double> offsets;
    for (int k = 0; k < slices; ++k)
        offsets.push_back(plan.jitter && plan.kind == CaseKind::MaskImage
                              ? dice.between(-0.3, 0.3) * pixel
                              : 0.0);
    return offsets;
}

/// Voxels that belong to what is cut off at flat ends become background.
void cut_ends(std::vector<float>& values, const Tree& tree, const Grid& grid, float outside) {
    const Eigen::Matrix3d to_index = grid.steps.inverse();
    for (const Branch& branch : tree.branches) {
        if (!branch.end || branch.end->kind != EndKind::Flat) continue;
        const double reach = 6.0 * branch.end->radius;
        const Vec3 centre = to_index * (branch.end->place - grid.origin);
        const Vec3 spacing = grid.steps.colwise().norm();
        const Eigen::Array3i from =
            (centre - reach * spacing.cwiseInverse()).array().floor().cast<int>().max(0);
        const Eigen::Array3i to =
            (centre + reach * spacing.cwiseInverse()).array().ceil().cast<int>().min(grid.size - 1);
        for (int k = from[2]; k <= to[2]; ++k)
            for (int j = from[1]; j <= to[1]; ++j)
                for (int i = from[0]; i <= to[0]; ++i) {
                    float& value = values[(static_cast<std::size_t>(k) *
                                               static_cast<std::size_t>(grid.size[1]) +
                                           static_cast<std::size_t>(j)) *
                                              static_cast<std::size_t>(grid.size[0]) +
                                          static_cast<std::size_t>(i)];
                    if (value < outside &&
                        is_cut_away(tree, branch, grid.origin + grid.steps * Vec3(i, j, k)))
                        value = outside;
                }
    }
}

}  // namespace

Image tree_image(const Tree& tree, const Plan& plan) {
    const Grid grid = grid_for(tree, plan);
    const double pixel = grid.steps.col(0).norm(), slice = grid.steps.col(2).norm();
    auto values = sampled(TreeField(tree), grid.origin, grid.steps, grid.size);
    cut_ends(values, tree, grid, static_cast<float>(pixel));
    const auto jitter = jitter_of(plan, grid.size[2], pixel);
    const std::size_t per_slice =
        static_cast<std::size_t>(grid.size[0]) * static_cast<std::size_t>(grid.size[1]);
    // the wall is seen through voxels, so intensities fade over about one
    const double blur = 0.5 * (pixel + 0.5 * (slice - pixel));
    for (std::size_t v = 0; v < values.size(); ++v) {
        const double distance = values[v];
        if (plan.kind == CaseKind::IntensityImage) {
            const double share = std::clamp(0.5 - 0.5 * distance / blur, 0.0, 1.0);
            values[v] = static_cast<float>(
                std::round(kInside * (share + plan.noise * normal_noise(plan.seed, v))));
        } else {
            values[v] = distance < jitter[v / per_slice] ? 1.0F : 0.0F;
        }
    }
    Image image;
    image.size = {grid.size[0], grid.size[1], grid.size[2]};
    image.index_to_patient.topLeftCorner<3, 3>() = grid.steps;
    image.index_to_patient.topRightCorner<3, 1>() = grid.origin;
    image.voxels = std::make_shared<const std::vector<float>>(std::move(values));
    return image;
}

}  // namespace vesselbench::forest
