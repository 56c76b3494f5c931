#include "geometry/image/contrast_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Background, contrast, offset of the wall times the contrast, and half the change of the blur's
/// variance along each axis times the contrast: what the image is linear in.
constexpr int kUnknowns = 6;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;

constexpr double kWidestBlur = 3.0;  // [voxels]

struct Sums {
    Matrix matrix = Matrix::Zero();
    Vector right = Vector::Zero();
    double squares = 0.0, count = 0.0;
};

/// Second difference along an axis [1/mm^2]; the border value repeats outside.
double second_difference(const Image& grid, const std::vector<float>& values,
                         const std::array<int, 3>& at, std::size_t axis, double spacing) {
    std::array<int, 3> before = at, after = at;
    before[axis] = std::max(at[axis] - 1, 0);
    after[axis] = std::min(at[axis] + 1, grid.size[axis] - 1);
    return (static_cast<double>(values[grid.offset(before[0], before[1], before[2])]) +
            values[grid.offset(after[0], after[1], after[2])] -
            2.0 * values[grid.offset(at[0], at[1], at[2])]) /
           (spacing * spacing);
}

Sums slice_sums(const Image& image, const ShownVessel& vessel, double contrast, int k) {
    const Vec3 spacing = image.spacing();
    Sums sums;
    for (int j = 0; j < image.size[1]; ++j)
        for (int i = 0; i < image.size[0]; ++i) {
            const std::size_t v = image.offset(i, j, k);
            if (vessel.near[v] == 0.0f) continue;
            const double value = static_cast<double>((*image.voxels)[v]) - vessel.background[v];
            if (contrast > 0.0 && is_other_structure(value / contrast, vessel.share[v])) continue;
            Vector row;
            row << 1.0, vessel.share[v], vessel.wall[v],
                second_difference(image, vessel.share, {i, j, k}, 0, spacing[0]),
                second_difference(image, vessel.share, {i, j, k}, 1, spacing[1]),
                second_difference(image, vessel.share, {i, j, k}, 2, spacing[2]);
            sums.matrix += row * row.transpose();
            sums.right += value * row;
            sums.squares += value * value;
            sums.count += 1.0;
        }
    return sums;
}

}  // namespace

bool is_other_structure(double brightness, float share) {
    constexpr double kBright = 0.5;
    constexpr float kNotThere = 0.05f;
    return share < kNotThere && brightness > kBright;
}

VesselContrast fit_contrast(const Image& image, const ShownVessel& vessel,
                            const VesselContrast& before) {
    std::vector<Sums> slices(static_cast<std::size_t>(image.size[2]));
    tbb::parallel_for(0, image.size[2], [&](int k) {
        slices[static_cast<std::size_t>(k)] = slice_sums(image, vessel, before.contrast, k);
    });
    Sums sums;  // added in order: the same bits on any number of threads
    for (const Sums& slice : slices) {
        sums.matrix += slice.matrix;
        sums.right += slice.right;
        sums.squares += slice.squares;
        sums.count += slice.count;
    }
    const Matrix inverse = sums.matrix.inverse();
    const Vector found = inverse * sums.right;
    if (!found.allFinite() || !(found[1] > 0.0))
        throw AlgorithmFailure("the image does not decide how bright the vessel is");
    const double variance =
        std::max(0.0, sums.squares - found.dot(sums.right)) / std::max(1.0, sums.count);
    VesselContrast contrast{.contrast = found[1],
                            .residual = std::sqrt(variance) / found[1],
                            .error = std::sqrt(std::max(0.0, variance * inverse(1, 1))) / found[1]};
    for (int a = 0; a < 3; ++a) {
        const double blurred = std::pow(before.blur[a], 2) + 2.0 * found[3 + a] / found[1];
        contrast.blur[a] =
            std::sqrt(std::clamp(blurred, 0.0, std::pow(kWidestBlur * image.spacing()[a], 2)));
    }
    return contrast;
}

}  // namespace vesselbench
