#include "geometry/image/least_bending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

using Values = std::vector<float>;

/// Least distance of the outline's own voxels from the surface, as a fraction of the smallest voxel
/// edge. With 0 the surface passes through voxel centres wherever it can bend less by that; of 0 to
/// 0.3, 0.1 gave the least mean distance to nine phantoms.
constexpr double kClearance = 0.1;

/// The same where a part is so thin that all its voxels belong to the outline: less would thin it
/// to a thread.
constexpr double kThinClearance = 0.25;

/// f_ii, f_jj, f_kk, f_ij, f_ik, f_jk at one voxel, times the roots of their weights.
using Bending = std::array<float, 6>;

/// Numbers of a voxel's neighbours at both sides along each axis (VoxelBand::neighbours).
constexpr std::array<std::array<std::size_t, 2>, 3> kSides = {{{0, 1}, {2, 3}, {4, 5}}};
/// The axes of the mixed derivatives; neighbours 6 + 2 p and 7 + 2 p lie along both axes of pair p.
constexpr std::array<std::array<std::size_t, 2>, 3> kPairs = {{{0, 1}, {0, 2}, {1, 2}}};

/// Half the sum of squared second differences [1/mm^2], each where all its voxels are in the band.
class BendingEnergy {
public:
    BendingEnergy(const VoxelBand& band, const Vec3& spacing) : band_(band), bending_(band.size()) {
        for (std::size_t a = 0; a < 3; ++a) {
            const double h = spacing[static_cast<Eigen::Index>(a)];
            along_[a] = static_cast<float>(1.0 / (h * h));
        }
        for (std::size_t p = 0; p < 3; ++p)  // a mixed derivative occurs twice in the Hessian
            across_[p] = std::sqrt(2.0f * along_[kPairs[p][0]] * along_[kPairs[p][1]]);
    }

    /// No direction is steeper: a second difference along an axis is at most 4 times the value.
    [[nodiscard]] float steepest() const {
        const float sum = along_[0] + along_[1] + along_[2];
        return 16.0f * sum * sum;
    }

    void gradient(const Values& f, Values& result) {
        for_each_vertex(f.size(), [&](std::size_t v) { bending_[v] = bending_at(f, v); });
        for_each_vertex(f.size(), [&](std::size_t v) { result[v] = gathered_at(v); });
    }

private:
    [[nodiscard]] Bending bending_at(const Values& f, std::size_t v) const {
        const auto& near = band_.neighbours[v];
        const auto value = [&](std::int32_t place) { return f[static_cast<std::size_t>(place)]; };
        Bending bending{};
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int32_t up = near[kSides[a][0]], down = near[kSides[a][1]];
            if (up >= 0 && down >= 0)
                bending[a] = along_[a] * (value(up) - 2.0f * f[v] + value(down));
        }
        for (std::size_t p = 0; p < 3; ++p) {
            const std::int32_t one = near[kSides[kPairs[p][0]][0]];
            const std::int32_t other = near[kSides[kPairs[p][1]][0]];
            const std::int32_t both = near[6 + 2 * p];
            if (one >= 0 && other >= 0 && both >= 0)
                bending[3 + p] = across_[p] * (value(both) - value(one) - value(other) + f[v]);
        }
        return bending;
    }

    /// Sum over the differences that a voxel takes part in.
    [[nodiscard]] float gathered_at(std::size_t v) const {
        const auto& near = band_.neighbours[v];
        const auto part = [&](std::int32_t place, std::size_t kind) {
            return place < 0 ? 0.0f : bending_[static_cast<std::size_t>(place)][kind];
        };
        float sum = 0.0f;
        for (std::size_t a = 0; a < 3; ++a)
            sum += along_[a] * (part(near[kSides[a][0]], a) - 2.0f * bending_[v][a] +
                                part(near[kSides[a][1]], a));
        for (std::size_t p = 0; p < 3; ++p)
            sum += across_[p] *
                   (bending_[v][3 + p] - part(near[kSides[kPairs[p][0]][1]], 3 + p) -
                    part(near[kSides[kPairs[p][1]][1]], 3 + p) + part(near[7 + 2 * p], 3 + p));
        return sum;
    }

    const VoxelBand& band_;
    std::vector<Bending> bending_;
    std::array<float, 3> along_{};
    std::array<float, 3> across_{};
};

}  // namespace

std::vector<float> voxel_clearances(const VoxelBand& band, const Vec3& spacing) {
    std::vector<float> least(band.size());
    const double h = spacing.minCoeff();
    for_each_vertex(band.size(), [&](std::size_t v) {
        least[v] = band.layer[v] > 1
                       ? band.depth[v]
                       : static_cast<float>(h * (is_thin(band, v) ? kThinClearance : kClearance));
    });
    return least;
}

std::vector<float> least_bending(const VoxelBand& band, const Vec3& spacing,
                                 const BendingBounds& bounds, int steps, const Progress& progress) {
    const auto on_its_side = [&](std::size_t v, float value) {
        return band.inside[v] != 0 ? std::max(value, bounds.least[v])
                                   : std::min(value, -bounds.least[v]);
    };
    const std::size_t n = band.size();
    Values f = bounds.start, before(n), slope(n);
    Values ahead = f;
    BendingEnergy energy(band, spacing);
    const float step = 1.0f / energy.steepest();
    double momentum = 1.0;
    for (int s = 0; s < steps; ++s) {
        progress.report(static_cast<double>(s) / steps, "finding a smooth surface");
        energy.gradient(ahead, slope);
        std::swap(before, f);
        for_each_vertex(n,
                        [&](std::size_t v) { f[v] = on_its_side(v, ahead[v] - step * slope[v]); });
        const auto turned = summed<double>(n, [&](double& sum, std::size_t v) {
            sum += static_cast<double>(ahead[v] - f[v]) * static_cast<double>(f[v] - before[v]);
        });
        const double last = std::exchange(
            momentum,
            turned > 0.0 ? 1.0 : 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum)));
        const auto beta = static_cast<float>(turned > 0.0 ? 0.0 : (last - 1.0) / momentum);
        for_each_vertex(n, [&](std::size_t v) { ahead[v] = f[v] + beta * (f[v] - before[v]); });
    }
    return f;
}

}  // namespace vesselbench
