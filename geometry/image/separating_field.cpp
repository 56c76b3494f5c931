#include "geometry/image/separating_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/image/iso_surface.h"
#include "geometry/image/voxel_band.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

/// Three layers on each side hold every second difference around the surface. With two, slices
/// three times as thick as the voxels come out worse; a fourth changes the mean distance by less
/// than 3 %.
constexpr int kLayers = 3;

/// Least distance of the outline's own voxels from the surface, as a fraction of the smallest voxel
/// edge. With 0 the surface passes through voxel centres wherever it can bend less by that; of 0 to
/// 0.3, 0.1 gave the least mean distance to nine phantoms.
constexpr double kClearance = 0.1;

/// The same where a part is so thin that all its voxels belong to the outline: less would thin it
/// to a thread.
constexpr double kThinClearance = 0.25;

/// After 150 steps the mean distance to the phantoms' surfaces no longer changes.
constexpr int kSteps = 200;

using Values = std::vector<float>;

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

/// Per voxel of the band its least distance from the surface [mm].
Values clearances(const VoxelBand& band, const Vec3& spacing) {
    Values least(band.size());
    const double h = spacing.minCoeff();
    for_each_vertex(band.size(), [&](std::size_t v) {
        least[v] = band.layer[v] > 1
                       ? band.depth[v]
                       : static_cast<float>(h * (is_thin(band, v) ? kThinClearance : kClearance));
    });
    return least;
}

/// Per voxel of the band the value of the function that bends least.
Values least_bending(const VoxelBand& band, const Vec3& spacing, const Progress& progress) {
    const Values least = clearances(band, spacing);
    const auto on_its_side = [&](std::size_t v, float value) {
        return band.inside[v] != 0 ? std::max(value, least[v]) : std::min(value, -least[v]);
    };
    const std::size_t n = band.size();
    Values f(n), before(n), slope(n);
    const auto half = static_cast<float>(0.5 * spacing.minCoeff());
    for (std::size_t v = 0; v < n; ++v)
        f[v] = (band.inside[v] != 0 ? 1.0f : -1.0f) * (band.depth[v] + half);
    Values ahead = f;
    BendingEnergy energy(band, spacing);
    const float step = 1.0f / energy.steepest();
    double momentum = 1.0;
    for (int s = 0; s < kSteps; ++s) {
        progress.report(static_cast<double>(s) / kSteps, "finding a smooth surface");
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

/// Values at both ends of a grid edge that crosses the outline.
struct Crossing {
    double inside = 0.0;
    double outside = 0.0;
};

std::vector<Crossing> crossings_of(const VoxelBand& band, const Values& f) {
    std::vector<Crossing> crossings;
    for (std::size_t v = 0; v < band.size(); ++v)
        for (const auto& [up, down] : kSides) {
            const std::int32_t place = band.neighbours[v][up];
            if (place < 0 || band.inside[v] == band.inside[static_cast<std::size_t>(place)])
                continue;
            const auto [outside, inside] = std::minmax(f[v], f[static_cast<std::size_t>(place)]);
            crossings.push_back({.inside = inside, .outside = outside});
        }
    return crossings;
}

/// The level at which edges are crossed midway in the mean: the grid lines along each axis then
/// have the length inside that the voxels say.
double fair_level(const std::vector<Crossing>& crossings) {
    double low = 0.0, high = 0.0;
    for (const Crossing& c : crossings) {
        low = std::min(low, c.outside);
        high = std::max(high, c.inside);
    }
    constexpr int kHalvings = 40;  // to 1e-12 of the range
    for (int h = 0; h < kHalvings; ++h) {
        const double level = 0.5 * (low + high);
        double beyond = 0.0;  // of the middles, towards outside
        for (const Crossing& c : crossings)
            beyond += std::clamp((c.inside - level) / (c.inside - c.outside), 0.0, 1.0) - 0.5;
        (beyond > 0.0 ? low : high) = level;
    }
    return 0.5 * (low + high);
}

/// Volume that the voxels of a mask say [mm^3]. The image ends at the outermost voxel centres: of a
/// voxel there, half lies within for each border it is at.
double voxel_volume(const Image& mask) {
    const auto share = [](int at, int size) { return at == 0 || at == size - 1 ? 0.5 : 1.0; };
    double count = 0.0;
    for (int k = 0; k < mask.size[2]; ++k)
        for (int j = 0; j < mask.size[1]; ++j) {
            const double of_line = share(k, mask.size[2]) * share(j, mask.size[1]);
            for (int i = 0; i < mask.size[0]; ++i)
                if (is_inside(mask.at(i, j, k))) count += of_line * share(i, mask.size[0]);
        }
    return count * mask.spacing().prod();
}

/// The function minus a level, on the whole image; voxel centres keep their sides.
Image field_at(const Image& mask, const VoxelBand& band, const Values& f, double level) {
    const auto beyond = static_cast<float>((kLayers + 1) * mask.spacing().maxCoeff());
    const auto least = static_cast<float>(1e-3 * mask.spacing().minCoeff());
    std::vector<float> values(mask.voxel_count());
    for_each_vertex(values.size(), [&](std::size_t v) {
        values[v] = is_inside((*mask.voxels)[v]) ? beyond : -beyond;
    });
    for_each_vertex(band.size(), [&](std::size_t b) {
        const auto value = static_cast<float>(f[b] - level);
        values[band.voxels[b]] =
            band.inside[b] != 0 ? std::max(value, least) : std::min(value, -least);
    });
    Image field = mask;
    field.voxels = std::make_shared<const std::vector<float>>(std::move(values));
    return field;
}

/// Area of the wall [mm^2], without the closures at the image's border.
double wall_area(const Surface& surface) {
    double sum = 0.0;
    for (const PatchMeasures& patch : measure_patches(surface))
        if (patch.kind == PatchKind::Wall) sum += patch.area;
    return sum;
}

}  // namespace

Image separating_field(const Image& mask, const Progress& progress) {
    const VoxelBand band = voxel_band(mask, kLayers);
    progress.check_cancelled();
    const Values f = least_bending(band, mask.spacing(), progress.part(0.0, 0.8));
    const double midway = fair_level(crossings_of(band, f));
    const Image field = field_at(mask, band, f, midway);
    progress.report(0.9, "finding a smooth surface");
    const Surface surface = iso_surface(field, 0.0, false, progress.silent());
    const double area = wall_area(surface);
    if (!(area > 0.0)) return field;
    // Chords cut off the volume between surface and triangles: 1 to 4 % of small vessels.
    return field_at(mask, band, f, midway - (voxel_volume(mask) - volume(surface)) / area);
}

}  // namespace vesselbench
