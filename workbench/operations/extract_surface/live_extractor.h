#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/image/coarse_image.h"
#include "geometry/image/extract_surface.h"
#include "geometry/image/histogram.h"
#include "workbench/case/checked_arguments.h"

namespace vesselbench {

/// A coarse image has no more voxels: its surface is found in less than a tenth of a second on two
/// cores.
inline constexpr std::size_t kCoarseVoxels = 1'200'000;

/// What `extract-surface` makes of an image, found again and again while its arguments change
/// (thesis 6.7.1): first from a coarse image, then as the operation itself does. What was cleaned
/// and resampled is kept while other arguments change. Not thread-safe.
class LiveExtractor {
public:
    /// \param most voxels of the coarse image
    /// \param vessel labels that are taken unless the arguments name others; empty: all
    /// \throw InvalidInput as extract_surface()
    LiveExtractor(Image image, std::optional<Image> mask, std::size_t most = kCoarseVoxels,
                  std::vector<int> vessel = {});

    struct State {
        Surface surface;
        std::optional<double> threshold;  ///< none: labels have no iso-value
        bool inside_below = false;
        std::size_t bodies = 0;  ///< found
        bool whole = false;      ///< extract-surface gives the same bits
    };

    /// From the coarse image, without any judgement of topology. None where that does not serve:
    /// the image itself is not larger, labels are wanted, or nothing is left in the coarse image.
    /// \throw as the operation; Cancelled
    [[nodiscard]] std::optional<State> coarse(const CheckedArguments& given,
                                              const Progress& progress);

    /// \throw as the operation; Cancelled
    [[nodiscard]] State whole(const CheckedArguments& given, const Progress& progress);

    /// Whether the image is larger than its coarse one.
    [[nodiscard]] bool has_coarse() const { return coarse_.has_value(); }

    /// Of the image, before any cleaning.
    [[nodiscard]] const std::shared_ptr<const ImageHistogram>& histogram() const {
        return histogram_;
    }

private:
    void make_coarse(const Image& image, const std::optional<Image>& mask, std::size_t most);

    bool with_mask_ = false;
    std::vector<int> vessel_;
    SurfaceExtractor extractor_;
    std::optional<SurfaceExtractor> coarse_;  ///< none: the image is coarse enough
    VoxelSteps steps_ = {1, 1, 1};
    std::shared_ptr<const ImageHistogram> histogram_;
};

}  // namespace vesselbench
