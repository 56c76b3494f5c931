#include "geometry/image/histogram.h"

#include <algorithm>

namespace vesselbench {

namespace {

constexpr double kTail = 2e-4;            ///< of the voxels, at either end [-]
constexpr std::size_t kFine = 1U << 16U;  ///< classes in which the tails are found

/// Counts the values between two ends; those beyond are left out.
std::vector<std::size_t> counted(const std::vector<float>& voxels, double least, double most,
                                 std::size_t classes) {
    std::vector<std::size_t> counts(classes, 0);
    const double scale = static_cast<double>(classes) / (most - least);
    for (const float voxel : voxels)
        if (voxel >= least && voxel <= most)
            ++counts[std::min(classes - 1, static_cast<std::size_t>((voxel - least) * scale))];
    return counts;
}

/// Number of classes from the begin that hold no more than so many voxels.
template <class Iterator>
std::size_t classes_of_tail(Iterator begin, Iterator end, double most) {
    double sum = 0.0;
    const Iterator beyond = std::find_if(
        begin, end, [&](std::size_t count) { return (sum += static_cast<double>(count)) > most; });
    return static_cast<std::size_t>(beyond - begin);
}

}  // namespace

ImageHistogram histogram_of(const Image& image, std::size_t classes) {
    const std::vector<float>& voxels = *image.voxels;
    const auto [low, high] = std::ranges::minmax(voxels);
    ImageHistogram histogram{.least = low, .most = high, .counts = {}};
    if (!(high > low)) return histogram;
    const auto fine = counted(voxels, low, high, kFine);
    const double tail = kTail * static_cast<double>(voxels.size());
    const double width = (histogram.most - histogram.least) / kFine;
    const std::size_t below = classes_of_tail(fine.begin(), fine.end(), tail);
    const std::size_t above = classes_of_tail(fine.rbegin(), fine.rend(), tail);
    histogram.most -= static_cast<double>(above) * width;
    histogram.least += static_cast<double>(below) * width;
    histogram.counts = counted(voxels, histogram.least, histogram.most, classes);
    return histogram;
}

}  // namespace vesselbench
