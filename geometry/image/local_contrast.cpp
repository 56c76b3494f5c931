#include "geometry/image/local_contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/image/grid_blur.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

using Values = std::vector<float>;

/// Standard deviations of the means of the background [voxels], and the weight in the nearer mean
/// of what the farther one says.
constexpr std::array<double, 2> kBackgroundWindows = {12.0, 4.0};
constexpr float kGranted = 1e-4f;
constexpr float kBeside = 0.02f;  // of a voxel: less of the vessel is beside it
constexpr float kOutlier = 5.0f;  // median deviations: another structure

/// Standard deviation of the regression's window [voxels], and how much of the shown vessel's
/// variance that its wall does not explain outweighs what the whole vessel says: of a vessel three
/// times as wide as the blur it is a tenth, of one as wide a thousandth.
constexpr double kWindow = 3.0;
constexpr double kPrior = 0.01;
/// Of the whole vessel's contrast.
constexpr double kLeast = 0.3, kMost = 2.0, kMostOffset = 0.1;

bool is_beside(const ShownVessel& vessel, std::size_t v) {
    return vessel.share[v] < kBeside && vessel.near[v] > 0.0f;
}

/// Sums of a window, each a mean once it is divided by the first.
enum Term { One, Share, Wall, Value, ShareShare, ShareWall, WallWall, ShareValue, WallValue };

constexpr std::size_t kTerms = 9;
using Window = std::array<double, kTerms>;

struct Line {
    double contrast = 1.0, offset = 0.0;
};

Line regression(const Window& m) {
    const double ss = m[ShareShare] - m[Share] * m[Share];
    const double sw = m[ShareWall] - m[Share] * m[Wall];
    const double ww = m[WallWall] - m[Wall] * m[Wall] + 1e-6;  // no wall: nothing to explain
    const double sv = m[ShareValue] - m[Share] * m[Value];
    const double wv = m[WallValue] - m[Wall] * m[Value];
    const double contrast =
        std::clamp((sv - sw * wv / ww + kPrior) / (ss - sw * sw / ww + kPrior), kLeast, kMost);
    const double of_wall = (wv - contrast * sw) / ww;
    return {contrast, std::clamp(m[Value] - contrast * m[Share] - of_wall * m[Wall], -kMostOffset,
                                 kMostOffset)};
}

}  // namespace

std::vector<float> local_background(const Image& image, const ShownVessel& vessel) {
    const std::size_t count = image.voxel_count();
    const Values& voxels = *image.voxels;
    Values beside;
    for (std::size_t v = 0; v < count; ++v)
        if (is_beside(vessel, v)) beside.push_back(voxels[v]);
    const auto typical = static_cast<float>(median(beside));
    for (float& value : beside) value = std::abs(value - typical);
    const float reach = kOutlier * static_cast<float>(median(std::move(beside)));
    Values means(count, typical);
    for (const double window : kBackgroundWindows) {
        Values sum(count, 0.0f), weight(count, 0.0f);
        for_each_vertex(count, [&](std::size_t v) {
            if (!is_beside(vessel, v) || std::abs(voxels[v] - typical) > reach) return;
            weight[v] = 1.0f;
            sum[v] = voxels[v] - typical;
        });
        blur_grid(sum, image.size, Vec3::Constant(window));
        blur_grid(weight, image.size, Vec3::Constant(window));
        for_each_vertex(count, [&](std::size_t v) {
            means[v] =
                typical + (kGranted * (means[v] - typical) + sum[v]) / (kGranted + weight[v]);
        });
    }
    return means;
}

LocalContrast local_contrast(const Image& image, const ShownVessel& vessel, double contrast) {
    const std::size_t count = image.voxel_count();
    const auto unit = static_cast<float>(image.spacing().maxCoeff());
    std::array<Values, kTerms> sums;
    for (Values& sum : sums) sum.assign(count, 0.0f);
    for_each_vertex(count, [&](std::size_t v) {
        if (vessel.near[v] == 0.0f) return;
        const auto value =
            static_cast<float>(((*image.voxels)[v] - vessel.background[v]) / contrast);
        const float share = vessel.share[v], wall = unit * vessel.wall[v];
        if (is_other_structure(value, share)) return;
        const std::array<float, kTerms> terms = {1.0f,        share,         wall,
                                                 value,       share * share, share * wall,
                                                 wall * wall, share * value, wall * value};
        for (std::size_t t = 0; t < kTerms; ++t) sums[t][v] = terms[t];
    });
    for (Values& sum : sums) blur_grid(sum, image.size, Vec3::Constant(kWindow));
    LocalContrast local{.contrast = Values(count, static_cast<float>(contrast)),
                        .offset = Values(count, 0.0f)};
    for_each_vertex(count, [&](std::size_t v) {
        constexpr float kLeastCount = 1e-3f;
        if (sums[One][v] < kLeastCount) return;
        Window means;
        for (std::size_t t = 0; t < kTerms; ++t)
            means[t] = static_cast<double>(sums[t][v]) / sums[One][v];
        const Line line = regression(means);
        local.contrast[v] = static_cast<float>(contrast * line.contrast);
        local.offset[v] = static_cast<float>(contrast * line.offset);
    });
    return local;
}

}  // namespace vesselbench
