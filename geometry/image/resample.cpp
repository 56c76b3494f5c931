#include "geometry/image/resample.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/image/lines.h"
#include "geometry/image/slice_distances.h"
#include "geometry/image/squared_distances.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr double kMostVoxels = 1 << 30;

/// The finer grid: same axes, same first voxel, cubic voxels up to the old last voxel.
Image cubic_grid(const Image& image, double edge) {
    if (!(edge > 0.0)) throw InvalidInput("the edge of the resampled voxels must be above 0 mm");
    const Vec3 spacing = image.spacing();
    Image grid;
    double count = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        // The slack keeps the last voxel if the edge divides the length exactly.
        constexpr double kSlack = 1e-6;
        const double n = std::floor((image.size[a] - 1) * spacing[axis] / edge + kSlack) + 1.0;
        count *= n;
        if (count > kMostVoxels)
            throw DiagnosedInput({.code = "too-many-voxels",
                                  .figures = {{"edge_mm", edge}},
                                  .remedies = {{.operation = "crop"}}});
        grid.size[a] = static_cast<int>(n);
    }
    if (count == 1.0)
        throw InvalidInput("resampling to voxels of " + formatted(edge) +
                           " mm leaves a single one of the image; take a smaller edge");
    grid.index_to_patient = image.index_to_patient;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        grid.index_to_patient.block<3, 1>(0, axis) *= edge / spacing[axis];
    return grid;
}

/// Turns samples into cubic B-spline coefficients, in place (mirrored ends).
void to_coefficients(std::vector<float>& line) {
    const std::size_t n = line.size();
    if (n < 2) return;
    const double pole = std::sqrt(3.0) - 2.0;
    const double gain = 6.0;
    constexpr double kForgotten =
        1e-9;  // power of the pole below which older samples are negligible
    double power = 1.0, first = 0.0;
    for (std::size_t i = 0; std::abs(power) > kForgotten; ++i, power *= pole) {
        const std::size_t period = i % (2 * n - 2);
        first += power * line[period < n ? period : 2 * n - 2 - period];
    }
    std::vector<double> c(n);
    c[0] = first;
    for (std::size_t i = 1; i < n; ++i) c[i] = line[i] + pole * c[i - 1];
    c[n - 1] = pole / (pole * pole - 1.0) * (c[n - 1] + pole * c[n - 2]);
    for (std::size_t i = n - 1; i-- > 0;) c[i] = pole * (c[i + 1] - c[i]);
    for (std::size_t i = 0; i < n; ++i) line[i] = static_cast<float>(gain * c[i]);
}

float bspline_at(const float* c, std::size_t n, double position) {
    if (n < 2) return c[0];
    const double base = std::floor(position), t = position - base;
    const double weights[4] = {(1 - t) * (1 - t) * (1 - t) / 6.0,
                               2.0 / 3.0 - 0.5 * t * t * (2.0 - t),
                               2.0 / 3.0 - 0.5 * (1 - t) * (1 - t) * (1.0 + t), t * t * t / 6.0};
    double sum = 0.0;
    const auto last = static_cast<long>(n) - 1;
    for (long k = 0; k < 4; ++k) {
        long i = std::abs(static_cast<long>(base) - 1 + k);
        if (i > last) i = 2 * last - i;
        sum += weights[k] * c[std::clamp(i, 0L, last)];
    }
    return static_cast<float>(sum);
}

float linear_at(const float* line, std::size_t n, double position) {
    const auto i = std::min(static_cast<std::size_t>(position), n - 1);
    const double t = position - static_cast<double>(i);
    const float next = line[std::min(i + 1, n - 1)];
    return static_cast<float>((1.0 - t) * line[i] + t * next);
}

/// An empty (or full) slice has no distances: it takes its neighbour's with the opposite sign, so
/// that the shape ends midway between the two.
float between_slices(const float* line, std::size_t n, double position) {
    const auto i = std::min(static_cast<std::size_t>(position), n - 1);
    const double t = position - static_cast<double>(i);
    float a = line[i], b = line[std::min(i + 1, n - 1)];
    if (std::abs(a) >= kFarSquared && std::abs(b) < kFarSquared) a = std::copysign(std::abs(b), a);
    if (std::abs(b) >= kFarSquared && std::abs(a) < kFarSquared) b = std::copysign(std::abs(a), b);
    return static_cast<float>((1.0 - t) * a + t * b);
}

Image with_voxels(Image grid, std::vector<float> voxels) {
    grid.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return grid;
}

}  // namespace

Image resample_intensities(const Image& image, double edge) {
    Image grid = cubic_grid(image, edge);
    std::vector<float> values = *image.voxels;
    std::array<int, 3> size = image.size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double step = edge / image.spacing()[static_cast<Eigen::Index>(axis)];
        for_each_line(values, size, static_cast<int>(axis), to_coefficients);
        values = resampled_lines(values, size, axis, grid.size[axis], step, bspline_at);
        size[axis] = grid.size[axis];
    }
    return with_voxels(std::move(grid), std::move(values));
}

Image resample_mask(const Image& mask, double edge) {
    Image grid = cubic_grid(mask, edge);
    Eigen::Index thickest = 0;
    mask.spacing().maxCoeff(&thickest);
    const auto stack = static_cast<std::size_t>(thickest);
    std::vector<float> values = signed_slice_distances(mask, stack);
    std::array<int, 3> size = mask.size;
    const std::array<std::size_t, 3> order = {stack, (stack + 1) % 3, (stack + 2) % 3};
    for (const std::size_t axis : order) {
        const double step = edge / mask.spacing()[static_cast<Eigen::Index>(axis)];
        values = resampled_lines(values, size, axis, grid.size[axis], step,
                                 axis == stack ? between_slices : linear_at);
        size[axis] = grid.size[axis];
    }
    for (float& v : values) v = v > 0.0f ? 1.0f : 0.0f;
    return with_voxels(std::move(grid), std::move(values));
}

}  // namespace vesselbench
