#include "workbench/operations/extract_surface/live_extractor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/operations/extract_surface/parameters.h"

namespace vesselbench {

namespace {

constexpr std::size_t kClasses = 256;  ///< of the histogram

/// A radius in coarse voxels; one that is not 0 stays above it.
int coarse_radius(int voxels, int step) {
    return voxels == 0 ? 0 : std::max(1, (voxels + step / 2) / step);
}

/// Diffusion reaches as far by the square of the step fewer iterations.
int coarse_iterations(int iterations, int step) {
    return iterations == 0 ? 0 : std::max(1, iterations / (step * step));
}

/// The same lengths on a coarse grid.
ExtractionParameters coarsened(ExtractionParameters parameters, const VoxelSteps& steps) {
    const int step = *std::ranges::max_element(steps);
    parameters.dilation = coarse_radius(parameters.dilation, step);
    parameters.cleaning.opening = coarse_radius(parameters.cleaning.opening, step);
    parameters.cleaning.closing = coarse_radius(parameters.cleaning.closing, step);
    parameters.cleaning.diffusion = coarse_iterations(parameters.cleaning.diffusion, step);
    parameters.resample.reset();
    parameters.with_topology = false;
    parameters.local_levels = false;  // they take seconds, and those of the image are others
    return parameters;
}

LiveExtractor::State state_of(Extraction found) {
    const bool labels = takes_voxels(found.method);
    return {.surface = std::move(found.surface),
            .threshold = labels ? std::nullopt : std::optional(found.threshold),
            .inside_below = found.inside_below,
            .bodies = found.bodies};
}

}  // namespace

LiveExtractor::LiveExtractor(Image image, std::optional<Image> mask, std::size_t most,
                             std::vector<int> vessel)
    : with_mask_(mask.has_value()), vessel_(std::move(vessel)), extractor_(image, mask) {
    histogram_ = std::make_shared<const ImageHistogram>(histogram_of(image, kClasses));
    make_coarse(image, mask, most);
}

void LiveExtractor::make_coarse(const Image& image, const std::optional<Image>& mask,
                                std::size_t most) {
    steps_ = coarse_steps(image, most);
    if (steps_ == VoxelSteps{1, 1, 1}) return;
    try {
        coarse_.emplace(coarse_image(image, steps_),
                        mask ? std::optional(coarse_mask(*mask, steps_)) : std::nullopt);
    } catch (const InvalidInput&) {  // the means are all equal
        coarse_.reset();
    }
}

std::optional<LiveExtractor::State> LiveExtractor::coarse(const CheckedArguments& given,
                                                          const Progress& progress) {
    if (!coarse_) return std::nullopt;
    const ExtractionParameters decided =
        extractor_.decided(extraction_parameters(given, with_mask_, vessel_), progress);
    if (takes_voxels(*decided.method)) return std::nullopt;
    try {
        return state_of(coarse_->extract(coarsened(decided, steps_), progress));
    } catch (const AlgorithmFailure&) {  // thin vessels may be seen in the whole image only
        return std::nullopt;
    }
}

LiveExtractor::State LiveExtractor::whole(const CheckedArguments& given, const Progress& progress) {
    State state =
        state_of(extractor_.extract(extraction_parameters(given, with_mask_, vessel_), progress));
    state.whole = true;
    return state;
}

}  // namespace vesselbench
