#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gpu/gpu_engine.h"
#include "smoothing/quality/smoothing_space.h"
#include "workbench/case/arguments.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// The inputs of `smooth` on a scene, for a search of its parameters.
struct SmoothingSubject {
    FilterParameters filter;
    FilterGround ground;
    std::shared_ptr<const std::vector<double>> weights;  ///< at the given arguments; null: all 1
    StaircaseWeights staircase;                          ///< null without staircase=true
    std::optional<StaircaseGround> staircase_ground;     ///< the GPU's inputs for the same
    bool mu_stays = false;                               ///< the user gave it
    double slice = 1.0;                                  ///< distance of the image's slices [mm]
};

/// \param arguments of `smooth`; resolved here
/// \throw UsageError, InvalidInput, AlgorithmFailure as `smooth`
[[nodiscard]] SmoothingSubject smoothing_subject(const Scene& scene, Arguments& arguments);

/// The engine that measures parameter sets, on the device named by the argument `device` of
/// `smooth`: auto takes a GPU if there is one. A GPU's engine must be used on this thread only.
/// \param planes also measures the error as printed in Eq. 6.2
[[nodiscard]] ChosenEngine smoothing_engine(const SmoothingSubject& subject,
                                            const Arguments& arguments, bool planes);

/// \param engine that searches the space
/// \param all_parameters for graphs
[[nodiscard]] SearchSpace smoothing_space_for(const SmoothingSubject& subject,
                                              const SmoothingEngine& engine, bool all_parameters);

/// The arguments of `smooth` as a set of that space.
[[nodiscard]] ParameterSet smoothing_set(const SmoothingSubject& subject,
                                         const Arguments& arguments, const SearchSpace& space);

/// The surface smoothed with a set, as in `smooth`, but without the check for crossing walls.
/// \throw InvalidInput if the space leaves the set out; Cancelled
[[nodiscard]] Surface smoothed_with(const SmoothingSubject& subject, const Surface& surface,
                                    const SearchSpace& space, const ParameterSet& set,
                                    const Progress& progress);

}  // namespace vesselbench
