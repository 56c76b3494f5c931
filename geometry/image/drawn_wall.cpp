#include "geometry/image/drawn_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/image/clean_image.h"
#include "geometry/image/lines.h"
#include "geometry/image/vessel_block.h"
#include "geometry/image/voxel_band.h"
#include "geometry/image/voxels.h"
#include "geometry/image/wall_topology.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

/// Those of separating_field(): its values are distances there.
constexpr int kLayers = 3;

/// Voxels farther from the wall [voxels] measure what nearer ones measure better.
constexpr double kMeasured = 1.5;

/// Standard deviation of the windows in which the levels on both sides are means [voxels].
constexpr double kWindow = 2.0;

/// Depth of voxels that count in full for these levels [voxels]: nearer ones are blurred with the
/// other side, also where contours are off.
constexpr double kDeep = 2.5;

/// The least slope at an edge [contrast per voxel]: a step blurred by more than two voxels is none.
constexpr double kLeastSlope = 0.15;

/// Contrasts below it are noise [standard deviations of the noise].
constexpr double kLeastContrast = 3.0;

/// How far contours are off, as a standard deviation [voxels]: what the image's edge is weighed
/// against.
constexpr double kContourError = 0.5;

/// Weight of equal offsets at neighbours, relative to an edge without noise, in each pass. The
/// first one has to follow contours that jump from slice to slice.
constexpr std::array<double, 3> kStiffness = {0.1, 0.3, 1.0};

/// Steps of the relaxation, after which offsets change by less than a hundredth of a voxel.
constexpr int kSteps = 60;

/// Of a field at a fractional index; beyond the image as at its border.
double value_at(const Image& image, const Vec3& index) {
    VoxelIndex low{};
    Vec3 t;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        const double at = std::clamp(index[axis], 0.0, image.size[a] - 1.0);
        low[a] = std::min(static_cast<int>(at), std::max(0, image.size[a] - 2));
        t[axis] = at - low[a];
    }
    return between_voxels(image, low, t);
}

/// Per voxel of an image, in parallel.
template <class Value>
Image mapped(const Image& grid, const Value& value) {
    std::vector<float> voxels(grid.voxel_count());
    for_each_vertex(voxels.size(), [&](std::size_t v) { voxels[v] = value(v); });
    return with_voxels(grid, std::move(voxels));
}

VoxelBlock block_of(const Image& mask, int margin) {
    VoxelBox box;
    for (std::size_t v = 0; v < mask.voxel_count(); ++v)
        if (is_inside((*mask.voxels)[v])) box.add(index_of(mask, v));
    return block_around(mask, box, margin);
}

/// Mean levels on both sides of the wall, of nearby voxels; the deeper ones count more.
struct SideLevels {
    Image inside, outside;
};

SideLevels side_levels(const Image& image, const Image& field) {
    const Vec3 spacing = image.spacing();
    const double voxel = std::cbrt(spacing.prod()), far = (kLayers + 0.5) * spacing.minCoeff();
    const auto mean = [&](double sign) {
        const Image weight = mapped(field, [&](std::size_t v) {
            const double depth = sign * (*field.voxels)[v] / voxel;
            // Far outside there are other things; far inside is the vessel.
            if (sign < 0.0 && depth * voxel > far) return 0.0f;
            const double share = std::clamp(depth / kDeep, 0.0, 1.0);
            return static_cast<float>(share * share * share);
        });
        const Image product =
            mapped(field, [&](std::size_t v) { return (*weight.voxels)[v] * (*image.voxels)[v]; });
        const Image sums = gaussian(product, kWindow * voxel);
        const Image weights = gaussian(weight, kWindow * voxel);
        return mapped(field, [&](std::size_t v) {
            constexpr float kLeast = 1e-6f;  // of a window that holds nothing of the side
            const float w = (*weights.voxels)[v];
            return w > kLeast ? (*sums.voxels)[v] / w : (*image.voxels)[v];
        });
    };
    return {mean(1.0), mean(-1.0)};
}

/// Where the wall is, seen from a voxel near it.
struct Foot {
    Vec3 index;          ///< of the point on the wall
    Vec3 step;           ///< along the outward normal, of 1 mm [voxels/mm]
    double voxel = 0.0;  ///< [mm] a voxel's length along the normal
    double slope = 0.0;  ///< of the field [-]
    double bend = 0.0;   ///< sum of the principal curvatures [1/mm], convex is positive
    Vec3 normal;         ///< unit, along the image's axes
};

double beside(const Image& field, VoxelIndex at, std::size_t axis, int step) {
    at[axis] = std::clamp(at[axis] + step, 0, field.size[axis] - 1);
    return field.at(at[0], at[1], at[2]);
}

/// None where the field is flat.
std::optional<Foot> foot_of(const Image& field, const VoxelIndex& at) {
    constexpr double kFlat = 0.2;
    const Vec3 spacing = field.spacing();
    const double value = field.at(at[0], at[1], at[2]);
    Vec3 gradient;
    double laplacian = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        const double up = beside(field, at, a, 1), down = beside(field, at, a, -1);
        const bool border = at[a] == 0 || at[a] == field.size[a] - 1;
        gradient[axis] = (up - down) / ((border ? 1.0 : 2.0) * spacing[axis]);
        laplacian += (up - 2.0 * value + down) / (spacing[axis] * spacing[axis]);
    }
    Foot foot;
    foot.slope = gradient.norm();
    if (!(foot.slope > kFlat)) return std::nullopt;
    foot.normal = -gradient / foot.slope;
    foot.step = foot.normal.cwiseQuotient(spacing);
    foot.voxel = 1.0 / foot.step.norm();
    foot.bend = -laplacian / foot.slope;
    foot.index = Vec3(at[0], at[1], at[2]) + value / foot.slope * foot.step;
    return foot;
}

/// The image and the mask's field, measured along the wall's normals.
class WallProbe {
public:
    WallProbe(const Image& image, const Image& field)
        : image_(image),
          levels_(side_levels(image, field)),
          // edge_contrast() is sqrt(5) standard deviations of the difference of two voxels.
          noise_(edge_contrast(image) / std::sqrt(10.0)) {}

    struct Edge {
        double offset = 0.0;  ///< [mm] outward from the wall
        double weight = 0.0;  ///< [-] in (0, 1]
    };

    /// The edge nearest to the wall within a voxel; none: the image shows none.
    [[nodiscard]] std::optional<Edge> edge_at(const Foot& foot) const {
        const double in = value_at(levels_.inside, foot.index),
                     out = value_at(levels_.outside, foot.index), contrast = in - out;
        if (!(std::abs(contrast) > kLeastContrast * noise_)) return std::nullopt;
        const double middle = 0.5 * (in + out), sign = contrast > 0.0 ? 1.0 : -1.0;
        const auto above = [&](double t) {
            return sign * (value_at(image_, foot.index + t * foot.step) - middle);
        };
        const auto crossing = nearest_crossing(above, foot.voxel);
        if (!crossing) return std::nullopt;
        const double reach = 0.5 * foot.voxel;
        const double slope = (above(*crossing - reach) - above(*crossing + reach)) / (2.0 * reach);
        const double share = slope * foot.voxel / std::abs(contrast);
        if (!(share > kLeastSlope)) return std::nullopt;
        const double error = noise_ / (slope * foot.voxel);  // voxels
        const double weight = 1.0 / (1.0 + error * error / (kContourError * kContourError));
        return Edge{bounded(*crossing + curved_shift(share, foot), foot.voxel), weight};
    }

private:
    template <class Above>
    static std::optional<double> nearest_crossing(const Above& above, double voxel) {
        constexpr int kSamples = 5;  // a quarter of a voxel apart
        constexpr double kReach = 1.25;
        const double h = kReach * voxel / kSamples;
        std::optional<double> nearest;
        double before = above(-kSamples * h);
        for (int s = -kSamples; s < kSamples; ++s) {
            const double next = above((s + 1) * h);
            if (before > 0.0 && next <= 0.0) {
                const double t = (s + before / (before - next)) * h;
                if (!nearest || std::abs(t) < std::abs(*nearest)) nearest = t;
            }
            before = next;
        }
        return nearest;
    }

    /// A blurred convex wall has its middle level inside: by sigma^2 / 2 times its curvature.
    /// \param fall of the contrast within half a voxel to each side, erf(h / (sqrt(8) sigma)) [-]
    static double curved_shift(double fall, const Foot& foot) {
        const double q = std::min(fall, 0.95), pi = std::numbers::pi;
        const double inverse_erf = 0.5 * std::sqrt(pi) * q * (1.0 + pi * q * q / 12.0);
        const double sigma = foot.voxel / (std::sqrt(8.0) * inverse_erf);
        constexpr double kMost = 0.3;  // voxels: beyond it the first order does not hold
        return std::clamp(0.5 * sigma * sigma * foot.bend, -kMost * foot.voxel, kMost * foot.voxel);
    }

    static double bounded(double offset, double voxel) { return std::clamp(offset, -voxel, voxel); }

    const Image& image_;
    SideLevels levels_;
    double noise_;
};

/// What is known at each voxel of the band.
struct Offsets {
    std::vector<float> edge;    ///< [mm]
    std::vector<float> weight;  ///< [-] 0: no edge
    std::vector<float> slope;   ///< of the field [-]
    std::vector<float> back;    ///< [mm] to where the wall was drawn
    std::vector<Vec3> normal;
    double seen = 0.0;
};

Offsets measured(const VoxelBand& band, const Image& field, const WallProbe& probe) {
    Offsets found;
    const std::size_t n = band.size();
    for (auto* values : {&found.edge, &found.weight, &found.slope, &found.back})
        values->assign(n, 0.0f);
    found.normal.assign(n, Vec3::Zero());
    for_each_vertex(n, [&](std::size_t b) {
        const auto foot = foot_of(field, index_of(field, band.voxels[b]));
        if (!foot) return;
        found.slope[b] = static_cast<float>(foot->slope);
        found.normal[b] = foot->normal;
        const double away = std::abs((*field.voxels)[band.voxels[b]]) / foot->slope;
        if (away > kMeasured * foot->voxel) return;
        const auto edge = probe.edge_at(*foot);
        if (!edge) return;
        found.edge[b] = static_cast<float>(edge->offset);
        found.weight[b] = static_cast<float>(edge->weight);
    });
    std::size_t wall = 0, seen = 0;
    for (std::size_t b = 0; b < n; ++b) {
        if (band.layer[b] > 1) continue;
        ++wall;
        if (found.weight[b] > 0.0f) ++seen;
    }
    found.seen = wall == 0 ? 0.0 : static_cast<double>(seen) / static_cast<double>(wall);
    return found;
}

/// Weight of a neighbour's offset: of the same wall, not of the one across the lumen.
float likeness(const Offsets& found, std::size_t a, std::size_t b) {
    const double cosine = found.normal[a].dot(found.normal[b]);
    return cosine > 0.0 ? static_cast<float>(cosine * cosine) : 0.0f;
}

/// Per voxel of the band the offset [mm] that fits the edges, changes least and is small: the
/// minimum of a sum of squares, found by relaxation.
std::vector<float> fitted(const VoxelBand& band, const Offsets& found, double stiffness) {
    constexpr float kDrawn = 0.2f;  // pulls to the mask where the image has no edge
    std::vector<float> d = found.edge, before(d.size());
    for (int s = 0; s < kSteps; ++s) {
        std::swap(d, before);
        for_each_vertex(d.size(), [&](std::size_t b) {
            const float pull = kDrawn * (1.0f - found.weight[b]);
            float sum = found.weight[b] * found.edge[b] + pull * found.back[b];
            float weight = found.weight[b] + pull;
            for (std::size_t side = 0; side < 6; ++side) {
                const std::int32_t place = band.neighbours[b][side];
                if (place < 0) continue;
                const auto other = static_cast<std::size_t>(place);
                const float like = static_cast<float>(stiffness) * likeness(found, b, other);
                sum += like * before[other];
                weight += like;
            }
            d[b] = weight > 0.0f ? sum / weight : 0.0f;
        });
    }
    return d;
}

/// Per voxel of the band the least and the largest value of the field: the wall moves by a voxel's
/// length along its normal.
struct WallBounds {
    std::vector<float> least, most;
};

WallBounds bounds_of(const VoxelBand& band, const Image& field) {
    WallBounds bounds{std::vector<float>(band.size()), std::vector<float>(band.size())};
    for_each_vertex(band.size(), [&](std::size_t b) {
        const float value = (*field.voxels)[band.voxels[b]];
        const auto foot = foot_of(field, index_of(field, band.voxels[b]));
        const auto way = static_cast<float>(foot ? foot->slope * foot->voxel : 0.0);
        bounds.least[b] = value - way;
        bounds.most[b] = value + way;
    });
    return bounds;
}

/// The field with its wall moved to the edges that are seen from where it is.
Image moved_once(const Image& image, const Image& field, const VoxelBand& band,
                 const WallBounds& bounds, double stiffness, double& seen) {
    Offsets found = measured(band, field, WallProbe(image, field));
    for (std::size_t b = 0; b < band.size(); ++b)
        if (found.slope[b] > 0.0f)
            found.back[b] =
                (0.5f * (bounds.least[b] + bounds.most[b]) - (*field.voxels)[band.voxels[b]]) /
                found.slope[b];
    seen = found.seen;
    const std::vector<float> offsets = fitted(band, found, stiffness);
    std::vector<float> values = *field.voxels;
    for (std::size_t b = 0; b < band.size(); ++b) {
        float& value = values[band.voxels[b]];
        value = std::clamp(value + found.slope[b] * offsets[b], bounds.least[b], bounds.most[b]);
    }
    return with_voxels(field, std::move(values));
}

/// Where the grid of a mask's curved field lies on the mask's.
struct FinerGrid {
    VoxelBlock block;       ///< of the mask's grid
    std::size_t stack = 0;  ///< the axis that has more planes
    int planes = 1;         ///< per slice
};

FinerGrid finer_grid(const Image& mask, const Image& fine) {
    FinerGrid grid;
    const Vec3 first = mask.to_index(fine.to_patient(Vec3::Zero()));
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        const auto planes =
            static_cast<int>(std::lround(mask.spacing()[axis] / fine.spacing()[axis]));
        grid.block.from[a] = static_cast<int>(std::lround(first[axis]));
        grid.block.size[a] = (fine.size[a] - 1) / planes + 1;
        if (planes > grid.planes) {
            grid.stack = a;
            grid.planes = planes;
        }
    }
    return grid;
}

/// A field on the finer grid where it meets the mask's grid; elsewhere the least value.
Image on_slices(const Image& mask, const Image& fine, const FinerGrid& grid) {
    Image part = part_of(mask, grid.block);
    part = mapped(part, [&](std::size_t v) {
        VoxelIndex at = index_of(part, v);
        at[grid.stack] *= grid.planes;
        return fine.at(at[0], at[1], at[2]);
    });
    return with_part(mask, grid.block, *part.voxels, *std::ranges::min_element(*fine.voxels));
}

/// The finer field plus what a field on the mask's grid gained, linear between slices.
Image with_gain(const Image& fine, const Image& before, const Image& after, const FinerGrid& grid) {
    const Image old = part_of(before, grid.block);
    std::vector<float> gain = *part_of(after, grid.block).voxels;
    for (std::size_t v = 0; v < gain.size(); ++v) gain[v] -= (*old.voxels)[v];
    const auto between = [](const float* line, std::size_t n, double position) {
        const auto low = std::min(static_cast<std::size_t>(position), n - 1);
        const auto t = static_cast<float>(position - static_cast<double>(low));
        return (1.0f - t) * line[low] + t * line[std::min(low + 1, n - 1)];
    };
    std::vector<float> values = resampled_lines(gain, old.size, grid.stack, fine.size[grid.stack],
                                                1.0 / grid.planes, between);
    for (std::size_t v = 0; v < values.size(); ++v) values[v] += (*fine.voxels)[v];
    return with_voxels(fine, std::move(values));
}

/// The field of a mask, on its grid, with its wall moved to the image's edges.
Image moved_field(const Image& image, const Image& mask, const Image& mask_field, double& seen,
                  const Progress& progress) {
    constexpr int kMargin = 8;  // the windows' reach
    const VoxelBlock block = block_of(mask, kMargin);
    const Image near = part_of(image, block), near_mask = part_of(mask, block),
                field = part_of(mask_field, block);
    progress.report(0.0, "finding the image's edges at the wall");
    const VoxelBand band = voxel_band(near_mask, kLayers);
    const WallBounds bounds = bounds_of(band, field);
    Image moved = field;
    // Later passes see levels and normals that the contours' errors no longer spoil.
    for (const double stiffness : kStiffness) {
        progress.check_cancelled();
        moved = moved_once(near, moved, band, bounds, stiffness, seen);
    }
    std::vector<float> values = *moved.voxels;
    keep_topology(field, band, values);
    return with_part(mask_field, block, values);
}

}  // namespace

DrawnWall drawn_wall(const Image& image, const Image& mask, const Image& smooth,
                     const Progress& progress) {
    DrawnWall wall{.mask_field = smooth};
    if (same_grid(mask, smooth)) {
        wall.field = moved_field(image, mask, smooth, wall.seen, progress);
        return wall;
    }
    const FinerGrid grid = finer_grid(mask, smooth);
    const Image before = on_slices(mask, smooth, grid);
    const Image after = moved_field(image, mask, before, wall.seen, progress);
    wall.field = with_gain(smooth, before, after, grid);
    return wall;
}

}  // namespace vesselbench
