#include "geometry/image/clean_image.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/image/lines.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/robust.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

Image with_voxels(const Image& image, std::vector<float> voxels) {
    Image result = image;
    result.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result;
}

/// Half of a Gaussian kernel, from its centre outward.
std::vector<double> half_kernel(double sigma_voxels) {
    constexpr double kCut = 4.0;         // standard deviations
    std::vector<double> kernel = {1.0};  // also where the square of sigma is too small for a number
    for (int i = 1; i <= static_cast<int>(std::ceil(kCut * sigma_voxels)); ++i)
        kernel.push_back(std::exp(-0.5 * i * i / (sigma_voxels * sigma_voxels)));
    return kernel;
}

void convolve(std::vector<float>& line, const std::vector<double>& kernel) {
    const std::vector<float> old = line;
    const auto n = static_cast<long>(line.size()), reach = static_cast<long>(kernel.size()) - 1;
    for (long i = 0; i < n; ++i) {
        double sum = 0.0, weight = 0.0;
        for (long q = std::max(0L, i - reach); q <= std::min(n - 1, i + reach); ++q) {
            const double w = kernel[static_cast<std::size_t>(std::abs(q - i))];
            sum += w * old[static_cast<std::size_t>(q)];
            weight += w;
        }
        line[static_cast<std::size_t>(i)] = static_cast<float>(sum / weight);
    }
}

template <class Better>
Image box_extreme(const Image& image, int radius, Better better) {
    if (radius < 0) throw InvalidInput("a morphological radius must be at least 0 voxels");
    if (radius == 0) return image;
    std::vector<float> values = *image.voxels;
    for (int axis = 0; axis < 3; ++axis)
        for_each_line(values, image.size, axis, [&](std::vector<float>& line) {
            const std::vector<float> old = line;
            const auto n = static_cast<long>(line.size());
            for (long i = 0; i < n; ++i)
                for (long q = std::max(0L, i - radius); q <= std::min(n - 1, i + radius); ++q)
                    line[static_cast<std::size_t>(i)] =
                        better(line[static_cast<std::size_t>(i)], old[static_cast<std::size_t>(q)]);
        });
    return with_voxels(image, std::move(values));
}

/// One explicit step of the diffusion for one slice.
void diffuse_slice(const Image& grid, const std::vector<float>& u, std::vector<float>& next, int k,
                   const Vec3& weight, double step, double contrast) {
    const auto [ni, nj, nk] = grid.size;
    for (int j = 0; j < nj; ++j)
        for (int i = 0; i < ni; ++i) {
            const std::size_t at = grid.offset(i, j, k);
            double change = 0.0;
            const auto flux = [&](bool there, std::size_t neighbour, double w) {
                if (!there) return;
                const double d = static_cast<double>(u[neighbour]) - u[at];
                const double ratio = d / contrast;
                change += w * std::exp(-ratio * ratio) * d;
            };
            const auto row = static_cast<std::size_t>(ni),
                       slice = row * static_cast<std::size_t>(nj);
            flux(i > 0, at - 1, weight.x());
            flux(i + 1 < ni, at + 1, weight.x());
            flux(j > 0, at - row, weight.y());
            flux(j + 1 < nj, at + row, weight.y());
            flux(k > 0, at - slice, weight.z());
            flux(k + 1 < nk, at + slice, weight.z());
            next[at] = static_cast<float>(u[at] + step * change);
        }
}

}  // namespace

Image gaussian(const Image& image, double sigma) {
    if (!(sigma >= 0.0))
        throw InvalidInput("the Gaussian's standard deviation must be at least 0 mm");
    if (sigma == 0.0) return image;
    std::vector<float> values = *image.voxels;
    for (int axis = 0; axis < 3; ++axis) {
        const auto kernel = half_kernel(sigma / image.spacing()[axis]);
        for_each_line(values, image.size, axis,
                      [&](std::vector<float>& line) { convolve(line, kernel); });
    }
    return with_voxels(image, std::move(values));
}

double edge_contrast(const Image& image) {
    std::vector<float> differences;
    const auto [ni, nj, nk] = image.size;
    for (int k = 0; k < nk; ++k)
        for (int j = 0; j < nj; ++j)
            for (int i = 0; i + 1 < ni; ++i) {
                const float d = std::abs(image.at(i + 1, j, k) - image.at(i, j, k));
                if (d > 0.0f) differences.push_back(d);
            }
    if (differences.empty()) return 1.0;
    return kNormalScatter * std::sqrt(5.0) * median(std::move(differences));
}

Image diffuse(const Image& image, const DiffusionParameters& parameters, const Progress& progress) {
    if (parameters.iterations < 0)
        throw InvalidInput("the number of diffusion iterations must be at least 0");
    const double contrast = parameters.contrast.value_or(edge_contrast(image));
    if (!(contrast > 0.0)) throw InvalidInput("the diffusion's contrast must be above 0");
    const Vec3 spacing = image.spacing();
    // Relative to the smallest edge; the step keeps the explicit scheme stable: step * 2 * sum
    // <= 1.
    const Vec3 weight = (spacing.minCoeff() / spacing.array()).square();
    const double step = 0.5 / weight.sum();
    std::vector<float> u = *image.voxels, next(u.size());
    for (int n = 0; n < parameters.iterations; ++n) {
        progress.report(static_cast<double>(n) / parameters.iterations, "diffusing");
        tbb::parallel_for(0, image.size[2],
                          [&](int k) { diffuse_slice(image, u, next, k, weight, step, contrast); });
        std::swap(u, next);
    }
    return with_voxels(image, std::move(u));
}

Image dilated(const Image& image, int radius) {
    return box_extreme(image, radius, [](float a, float b) { return std::max(a, b); });
}

Image eroded(const Image& image, int radius) {
    return box_extreme(image, radius, [](float a, float b) { return std::min(a, b); });
}

Image opened(const Image& image, int radius) {
    return dilated(eroded(image, radius), radius);
}

Image closed(const Image& image, int radius) {
    return eroded(dilated(image, radius), radius);
}

}  // namespace vesselbench
