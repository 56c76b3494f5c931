#include "geometry/image/threshold.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "geometry/image/clean_image.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

template <class Function>
Image mapped_voxels(const Image& image, const Function& value) {
    std::vector<float> voxels(image.voxels->size());
    for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = value((*image.voxels)[v]);
    Image result = image;
    result.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result;
}

bool whole_numbers_from_zero(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(),
                       [](float v) { return v >= 0.0f && v == std::floor(v); });
}

/// Fraction of adjacent pairs (both above 0) with equal values.
double equal_neighbours(const Image& image) {
    std::size_t pairs = 0, equal = 0;
    const auto [ni, nj, nk] = image.size;
    for (int k = 0; k < nk; ++k)
        for (int j = 0; j < nj; ++j)
            for (int i = 0; i + 1 < ni; ++i) {
                const float a = image.at(i, j, k), b = image.at(i + 1, j, k);
                if (a <= 0.0f || b <= 0.0f) continue;
                ++pairs;
                equal += a == b ? 1 : 0;
            }
    return pairs == 0 ? 1.0 : static_cast<double>(equal) / static_cast<double>(pairs);
}

/// Fraction of the image's border voxels with a value above 0.
double border_above_zero(const Image& image) {
    std::size_t border = 0, above = 0;
    const auto [ni, nj, nk] = image.size;
    for (int k = 0; k < nk; ++k)
        for (int j = 0; j < nj; ++j)
            for (int i = 0; i < ni; ++i)
                if (i == 0 || j == 0 || k == 0 || i == ni - 1 || j == nj - 1 || k == nk - 1) {
                    ++border;
                    above += image.at(i, j, k) > 0.0f ? 1 : 0;
                }
    return static_cast<double>(above) / static_cast<double>(border);
}

/// Values of the voxels where 0.5 <= mask and the other mask is below.
std::vector<float> values_between(const Image& image, const Image& outer, const Image* inner) {
    std::vector<float> values;
    for (std::size_t v = 0; v < image.voxels->size(); ++v)
        if ((*outer.voxels)[v] >= 0.5f && !(inner && (*inner->voxels)[v] >= 0.5f))
            values.push_back((*image.voxels)[v]);
    return values;
}

}  // namespace

std::string to_string(ImageKind kind) {
    switch (kind) {
        case ImageKind::Labels:
            return "labels";
        case ImageKind::LevelSet:
            return "level-set";
        default:
            return "intensity";
    }
}

ImageJudgement judge(const Image& image) {
    const auto [least, most] = std::minmax_element(image.voxels->begin(), image.voxels->end());
    constexpr double kMostlyEqual = 0.75;  // label maps: above 0.8; intensities: below 0.3
    if (whole_numbers_from_zero(*image.voxels) && equal_neighbours(image) >= kMostlyEqual)
        return {ImageKind::Labels, false,
                "whole numbers from 0 on, equal among neighbours: taken as labels"};
    constexpr double kSameSize = 0.01;
    if (*least < 0.0f && *most > 0.0f && std::abs(*least + *most) <= kSameSize * *most) {
        const bool below = border_above_zero(image) > 0.5;
        return {ImageKind::LevelSet, below,
                std::string("values symmetric about 0: taken as a level set, inside ") +
                    (below ? "below" : "above") + " 0, since the image's border lies " +
                    (below ? "above" : "below")};
    }
    return {ImageKind::Intensity, false, "taken as intensities"};
}

std::vector<int> labels_of(const Image& image) {
    std::vector<int> labels;
    for (const auto& [label, volume] : label_volumes(image)) labels.push_back(label);
    return labels;
}

std::map<int, double> label_volumes(const Image& image) {
    const double voxel = std::abs(image.index_to_patient.topLeftCorner<3, 3>().determinant());
    std::map<int, std::size_t> counts;
    float last = 0.0f;
    std::size_t* count = nullptr;  // of the last value: neighbours are mostly equal
    for (const float v : *image.voxels) {
        if (!(v > 0.0f)) continue;
        if (v != last || count == nullptr) count = &counts[static_cast<int>(std::lround(v))];
        last = v;
        ++*count;
    }
    std::map<int, double> volumes;
    for (const auto& [label, voxels] : counts) volumes[label] = voxel * static_cast<double>(voxels);
    return volumes;
}

Image mask_of_labels(const Image& image, const std::vector<int>& labels) {
    const std::set<int> wanted(labels.begin(), labels.end());
    return mapped_voxels(image, [&](float v) {
        const bool inside =
            wanted.empty() ? v > 0.0f : wanted.contains(static_cast<int>(std::lround(v)));
        return inside ? 1.0f : 0.0f;
    });
}

Image mask_of_iso(const Image& image, double iso, bool inside_below) {
    return mapped_voxels(
        image, [&](float v) { return (inside_below ? v <= iso : v >= iso) ? 1.0f : 0.0f; });
}

double otsu(const std::vector<float>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    if (values.empty() || !(*most > *least))
        throw InvalidInput("all voxels have the same value: there is nothing to separate");
    constexpr std::size_t kBins = 1024;
    const double low = *least, width = (static_cast<double>(*most) - low) / kBins;
    std::vector<double> count(kBins, 0.0);
    for (const float v : values)
        ++count[std::min(kBins - 1, static_cast<std::size_t>((v - low) / width))];
    double total = 0.0, sum = 0.0;
    for (std::size_t b = 0; b < kBins; ++b) {
        total += count[b];
        sum += count[b] * static_cast<double>(b);
    }
    double below = 0.0, sum_below = 0.0, best = -1.0;
    std::size_t first = 0, last = 0;  // an empty range between two classes: use its middle
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
        below += count[b];
        sum_below += count[b] * static_cast<double>(b);
        if (below == 0.0 || below == total) continue;
        const double difference = sum_below / below - (sum - sum_below) / (total - below);
        const double between = below * (total - below) * difference * difference;
        if (between > best) {
            best = between;
            first = b;
        }
        if (between == best) last = b;
    }
    return low + width * (0.5 * static_cast<double>(first + last) + 1.0);
}

namespace {

/// Otsu's threshold of all voxels, then of the brighter ones, until these are few.
double bright_class(const Image& image) {
    constexpr double kLargestShare = 0.05, kMostlyTissue = 0.7;
    std::vector<float> above = *image.voxels;
    double threshold = otsu(above);
    for (;;) {
        std::erase_if(above, [&](float v) { return v < threshold; });
        const auto [least, most] = std::minmax_element(above.begin(), above.end());
        const auto count = static_cast<double>(above.size());
        if (count <= kLargestShare * static_cast<double>(image.voxel_count()) || *least >= *most)
            return threshold;
        const double next = otsu(above);
        const auto below =
            std::count_if(above.begin(), above.end(), [&](float v) { return v < next; });
        if (static_cast<double>(below) < kMostlyTissue * count) return threshold;
        threshold = next;
    }
}

constexpr int kLayer = 2;  ///< of voxels at a wall

/// Medians of voxels of a mask and of the two-voxel layer around it.
struct LayerMedians {
    double inside = 0.0;
    double around = 0.0;

    [[nodiscard]] double middle() const { return 0.5 * (inside + around); }
};

/// \param core voxels of the mask that do not count; may be null
/// \return empty if no voxel counts inside, or none is around
std::optional<LayerMedians> layer_medians(const Image& image, const Image& mask, const Image* core,
                                          const Progress& progress) {
    const auto inside = values_between(image, mask, core);
    progress.check_cancelled();
    const auto around = values_between(image, dilated(mask, kLayer), &mask);
    if (inside.empty() || around.empty()) return std::nullopt;
    progress.check_cancelled();
    return LayerMedians{.inside = median(inside), .around = median(around)};
}

}  // namespace

double bright_threshold(const Image& image, const Progress& progress) {
    constexpr int kMostRounds = 4;
    constexpr double kSettled = 0.01;  // of the difference of the levels
    double threshold = bright_class(image);
    for (int round = 0; round < kMostRounds; ++round) {
        progress.check_cancelled();
        const Image bright = mask_of_iso(image, threshold, false);
        const Image core = eroded(bright, kLayer);
        const auto levels = layer_medians(image, bright, &core, progress);
        if (!levels) return threshold;
        const double last = std::exchange(threshold, levels->middle());
        if (std::abs(threshold - last) < kSettled * (levels->inside - levels->around)) break;
    }
    return threshold;
}

double masked_threshold(const Image& image, const Image& mask, const Progress& progress) {
    const auto levels = layer_medians(image, mask, nullptr, progress);
    if (!levels)
        throw DiagnosedInput({.code = "mask-without-border",
                              .operation = "extract-surface",
                              .remedies = {{.arguments = {{"threshold", ""}}}}});
    if (!(levels->inside > levels->around))
        throw DiagnosedInput({.code = "mask-not-brighter",
                              .operation = "extract-surface",
                              .remedies = {{.arguments = {{"threshold", ""}, {"inside", "below"}}},
                                           {.arguments = {{"method", "labels"}}}}});
    return levels->middle();
}

Image masked_intensities(const Image& image, const Image& dilated_mask, double threshold,
                         bool inside_below) {
    const auto is_inner = [&](float v) { return inside_below ? v <= threshold : v >= threshold; };
    std::vector<float> background;
    for (std::size_t v = 0; v < image.voxels->size(); ++v)
        if ((*dilated_mask.voxels)[v] < 0.5f && !is_inner((*image.voxels)[v]))
            background.push_back((*image.voxels)[v]);
    const auto [least, most] = std::minmax_element(image.voxels->begin(), image.voxels->end());
    const float value = background.empty() ? (inside_below ? *most : *least)
                                           : static_cast<float>(median(background));
    std::vector<float> voxels = *image.voxels;
    for (std::size_t v = 0; v < voxels.size(); ++v)
        if ((*dilated_mask.voxels)[v] < 0.5f && is_inner(voxels[v])) voxels[v] = value;
    Image result = image;
    result.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result;
}

}  // namespace vesselbench
