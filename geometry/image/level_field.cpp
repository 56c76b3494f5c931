#include "geometry/image/level_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geometry/image/grid_blur.h"
#include "geometry/image/local_contrast.h"
#include "geometry/image/occupancy.h"
#include "geometry/image/sampled_levels.h"
#include "geometry/image/vessel_block.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

using Values = std::vector<float>;

constexpr int kMostRounds = 20;
constexpr double kSettled = 3e-3;      // of the contrast: root mean square change of the levels
constexpr double kUnsettled = 0.03;    // the same after the last round: they do not settle
constexpr float kStep = 0.6f;          // of the way to the new levels: a full one can swing
constexpr double kFirstBlur = 0.6;     // [voxels]
constexpr double kAlongWall = 1.0;     // [voxels] standard deviation of the mean along the wall
constexpr double kNearWall = 1.5;      // [voxels] the same, of what counts as near it
constexpr float kLeastWeight = 1e-4f;  // of a flat wall's: so far from any wall there is no level

/// No lower than that of a vessel of the blur's own width: below it noise decides.
constexpr float kLowestShare = 0.27f;
constexpr float kLeastAbove = 0.2f;  // of the contrast, above the background

/// Voxels beyond the vessel that the threshold shows: its walls move, but it reaches no farther,
/// and into nothing beside it.
constexpr int kReach = 2;

/// What is no vessel of one contrast: the fit leaves more of it, or the levels enclose as much more
/// than the threshold.
constexpr double kMostResidual = 0.25, kMostGrowth = 2.0;

/// About 110 bytes for each: 3.4 GiB.
constexpr std::size_t kMostVoxels = std::size_t{32} << 20;

/// The levels of a vessel in a block of an image, and the vessel that they enclose.
class Synthesis {
public:
    Synthesis(Image image, double threshold, VesselBody body)
        : image_(std::move(image)),
          spacing_(image_.spacing()),
          threshold_(static_cast<float>(threshold)),
          body_(std::move(body)),
          levels_(image_.voxel_count(), threshold_) {
        fit_.blur = kFirstBlur * spacing_;
        reach_ = around_vessel(image_, threshold, body_, kReach);
    }

    void solve(const Progress& progress) {
        double change = 1.0;
        for (int round = 0; round < kMostRounds && change > kSettled; ++round) {
            progress.report(static_cast<double>(round) / kMostRounds,
                            "finding the local threshold");
            show_vessel();
            if (round == 0) first_volume_ = volume_;
            shown_.background = local_background(image_, shown_);
            fit_ = fit_contrast(image_, shown_, fit_);
            change = set_levels(local_contrast(image_, shown_, fit_.contrast));
            if (volume_ > kMostGrowth * first_volume_)
                throw AlgorithmFailure(
                    "the local threshold reaches into the vessel's surroundings");
        }
        if (change > kUnsettled) throw AlgorithmFailure("the local threshold does not converge");
        if (fit_.residual > kMostResidual)
            throw AlgorithmFailure("the image is not like a vessel of one contrast: " +
                                   formatted(100.0 * fit_.residual, "%.0f %%") +
                                   " of the contrast is left unexplained at its wall");
        bridge_gaps();
    }

    [[nodiscard]] const Values& levels() const { return levels_; }

    [[nodiscard]] WallLevels wall_levels() const {
        WallLevels wall{
            .found = fit_, .core = core_, .volume_at_threshold = first_volume_ / volume_};
        double area = 0.0, swept = 0.0, thin = 0.0;
        wall.lowest = wall.highest = at(levels_, crossings_.front());
        for (const WallCrossing& c : crossings_) {
            const double share = at(shown_.share, c), level = at(levels_, c);
            area += c.area;
            thin += share < kLowestShare ? c.area : 0.0;
            // With a contrast larger by a fraction, the wall is where the share is larger by it;
            // the share falls by the blurred wall per length.
            swept += c.area * share / std::max(1e-6, static_cast<double>(at(shown_.wall, c)));
            wall.lowest = std::min(wall.lowest, level);
            wall.highest = std::max(wall.highest, level);
        }
        wall.volume_error =
            swept / volume_ * std::hypot(2.0 * fit_.error, std::max(0.0, 1.0 - core_));
        wall.undetermined = thin / area;
        return wall;
    }

private:
    [[nodiscard]] static float at(const Values& values, const WallCrossing& c) {
        return (1.0f - c.share) * values[c.from] + c.share * values[c.to];
    }

    static void add(Values& values, const WallCrossing& c, float value) {
        values[c.from] += (1.0f - c.share) * value;
        values[c.to] += c.share * value;
    }

    void blur(Values& values, const Vec3& voxels) const { blur_grid(values, image_.size, voxels); }

    /// What the levels enclose, as the scanner shows it.
    void show_vessel() {
        Values inside(levels_.size());
        for_each_vertex(inside.size(),
                        [&](std::size_t v) { inside[v] = (*image_.voxels)[v] - levels_[v]; });
        keep_vessel(image_, body_, inside);
        crossings_ = wall_crossings(image_, inside);
        if (crossings_.empty()) throw AlgorithmFailure("the vessel has no wall in the image");
        shown_.share = occupancy(image_, inside, crossings_);
        const double voxel = spacing_.prod();
        volume_ = 0.0;
        for (const float share : shown_.share) volume_ += voxel * share;
        shown_.wall.assign(levels_.size(), 0.0f);
        for (const WallCrossing& c : crossings_)
            add(shown_.wall, c, c.area / static_cast<float>(voxel));
        shown_.near = shown_.wall;
        blur(shown_.share, fit_.blur.cwiseQuotient(spacing_));
        blur(shown_.wall, fit_.blur.cwiseQuotient(spacing_));
        blur(shown_.near, Vec3::Constant(kNearWall));
        for (float& weight : shown_.near) weight = weight < least_wall() ? 0.0f : weight;
        core_ = *std::ranges::max_element(shown_.share);
    }

    /// [1/mm]
    [[nodiscard]] float least_wall() const {
        return kLeastWeight / static_cast<float>(spacing_.maxCoeff());
    }

    /// \return the root mean square change, over the contrast
    double set_levels(const LocalContrast& local) {
        Values sum(levels_.size(), 0.0f), weight(levels_.size(), 0.0f);
        for (const WallCrossing& c : crossings_) {
            add(sum, c, c.area * std::max(at(shown_.share, c), kLowestShare));
            add(weight, c, c.area);
        }
        blur(sum, Vec3::Constant(kAlongWall));
        blur(weight, Vec3::Constant(kAlongWall));
        const float least = least_wall() * static_cast<float>(spacing_.prod());
        double squares = 0.0, count = 0.0;
        for (std::size_t v = 0; v < levels_.size(); ++v) {
            if (weight[v] < least || reach_[v] == 0.0f) continue;
            const float above = std::max(local.offset[v] + local.contrast[v] * sum[v] / weight[v],
                                         kLeastAbove * static_cast<float>(fit_.contrast));
            const float level = shown_.background[v] + above;
            const float step = kStep * (level - levels_[v]);
            squares += std::pow(step / fit_.contrast, 2);
            count += 1.0;
            levels_[v] += step;
        }
        return count > 0.0 ? std::sqrt(squares / count) : 0.0;
    }

    /// Where the levels break a vessel that the threshold shows in one piece, the threshold stays:
    /// a vessel that is a little too thick can be mended, one that is lost is not seen.
    void bridge_gaps() {
        Values inside(levels_.size());
        for_each_vertex(inside.size(),
                        [&](std::size_t v) { inside[v] = (*image_.voxels)[v] - levels_[v]; });
        for (const std::size_t v : voxels_of_gaps(image_, threshold_, body_, inside))
            levels_[v] = std::min(levels_[v], threshold_);
    }

    Image image_;
    Vec3 spacing_;
    float threshold_;
    VesselBody body_;
    VesselContrast fit_;
    Values levels_;
    Values reach_;  ///< not 0: where the vessel may be
    ShownVessel shown_;
    std::vector<WallCrossing> crossings_;
    double volume_ = 0.0, first_volume_ = 0.0;  ///< [mm^3] at the levels, and at the threshold
    double core_ = 0.0;
};

}  // namespace

LevelField find_levels(const Image& image, double threshold, const VesselBody& body,
                       const Progress& progress) {
    const VoxelBlock block = block_around_vessel(image, threshold, body);
    if (block.voxel_count() > kMostVoxels)
        throw DiagnosedFailure(
            {.code = "too-large-for-local-levels",
             .figures = {{"million_voxels",
                          std::ldexp(static_cast<double>(block.voxel_count()), -20)},
                         {"most_million_voxels",
                          std::ldexp(static_cast<double>(kMostVoxels), -20)}},
             .remedies = {{.operation = "crop"}}});
    Synthesis synthesis(part_of(image, block), threshold, body);
    synthesis.solve(progress);
    return {.levels = with_part(image, block, synthesis.levels(), static_cast<float>(threshold)),
            .wall = synthesis.wall_levels()};
}

namespace {

constexpr int kBox = 40;                ///< edge of a sample [voxels]
constexpr std::size_t kFewInside = 64;  ///< voxels of the vessel: fewer have no wall to speak of

/// A box of an image with the vessel's voxels in it.
struct VesselSample {
    VoxelBlock block;
    std::size_t inside = 0;
    std::size_t first = 0;  ///< offset of one of them in the image
};

/// The boxes of a grid that the vessel passes through.
std::vector<VesselSample> boxes_of(const Image& image, const Values& inside) {
    std::array<int, 3> count{};
    for (std::size_t a = 0; a < 3; ++a) count[a] = (image.size[a] + kBox - 1) / kBox;
    std::vector<VesselSample> boxes(static_cast<std::size_t>(count[0] * count[1] * count[2]));
    for (int k = 0; k < image.size[2]; ++k)
        for (int j = 0; j < image.size[1]; ++j)
            for (int i = 0; i < image.size[0]; ++i) {
                const std::size_t v = image.offset(i, j, k);
                if (inside[v] < 0.0f) continue;
                const std::array<int, 3> at = {i / kBox, j / kBox, k / kBox};
                VesselSample& box =
                    boxes[static_cast<std::size_t>((at[2] * count[1] + at[1]) * count[0] + at[0])];
                for (std::size_t a = 0; a < 3; ++a) {
                    box.block.from[a] = at[a] * kBox;
                    box.block.size[a] = std::min(kBox, image.size[a] - at[a] * kBox);
                }
                box.first = v;
                ++box.inside;
            }
    std::erase_if(boxes, [](const VesselSample& box) { return box.inside < kFewInside; });
    return boxes;
}

/// The first, and then every so many, so that they have about `most` voxels.
std::vector<VesselSample> spread_over(const std::vector<VesselSample>& boxes, std::size_t most) {
    std::size_t voxels = 0;
    for (const VesselSample& box : boxes) voxels += box.block.voxel_count();
    const std::size_t every = std::max<std::size_t>(1, (voxels + most - 1) / most);
    std::vector<VesselSample> chosen;
    for (std::size_t i = every / 2; i < boxes.size(); i += every) chosen.push_back(boxes[i]);
    return chosen;
}

Vec3 place_of(const Image& image, std::size_t offset) {
    const auto row = static_cast<std::size_t>(image.size[0]),
               column = static_cast<std::size_t>(image.size[1]);
    return image.to_patient(Vec3(static_cast<double>(offset % row),
                                 static_cast<double>(offset / row % column),
                                 static_cast<double>(offset / row / column)));
}

/// By the vessel's voxels in the boxes; those that are not like a vessel say nothing.
double ratio_in(const Image& image, double threshold, const std::vector<VesselSample>& boxes,
                const Progress& progress) {
    double at_threshold = 0.0, at_levels = 0.0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double share = 1.0 / static_cast<double>(boxes.size());
        const double done = static_cast<double>(i) * share;
        try {
            Synthesis synthesis(part_of(image, boxes[i].block), threshold,
                                {.seed = place_of(image, boxes[i].first)});
            synthesis.solve(progress.part(done, done + share));
            const auto voxels = static_cast<double>(boxes[i].inside);
            at_threshold += voxels;
            at_levels += voxels / synthesis.wall_levels().volume_at_threshold;
        } catch (const AlgorithmFailure&) {
            continue;
        }
    }
    if (at_levels == 0.0) throw AlgorithmFailure("no part of the image is like a blurred vessel");
    return at_threshold / at_levels;
}

}  // namespace

double volume_at_threshold(const Image& image, double threshold, const VesselBody& body,
                           std::size_t most, const Progress& progress) {
    const VoxelBlock block = block_around_vessel(image, threshold, body);
    if (block.voxel_count() <= most)
        return find_levels(image, threshold, body, progress).wall.volume_at_threshold;
    const Image part = part_of(image, block);
    Values inside(part.voxel_count());
    for_each_vertex(inside.size(), [&](std::size_t v) {
        inside[v] = (*part.voxels)[v] - static_cast<float>(threshold);
    });
    keep_vessel(part, body, inside);
    progress.check_cancelled();
    return ratio_in(part, threshold, spread_over(boxes_of(part, inside), most), progress);
}

}  // namespace vesselbench
