#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gpu/gpu_engine.h"
#include "smoothing/quality/smoothing_space.h"
#include "workbench/case/arguments.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// What `smooth` would do with a scene, as a search of its parameters needs it.
struct SmoothingSubject {
    FilterParameters filter;
    FilterGround ground;
    std::shared_ptr<const std::vector<double>> weights;  ///< at the given arguments; null: all 1
    StaircaseWeights staircase;                          ///< null without staircase=true
    std::optional<StaircaseGround> staircase_ground;     ///< what a GPU makes the same from
    bool mu_stays = false;                               ///< the user gave it
    double slice = 1.0;                                  ///< distance of the image's slices [mm]
};

/// \param arguments of `smooth`; resolved here
/// \throw UsageError, InvalidInput, AlgorithmFailure as `smooth`
[[nodiscard]] SmoothingSubject smoothing_subject(const Scene& scene, Arguments& arguments);

/// What measures parameter sets, on the device that the argument `device` of `smooth` names: auto
/// takes a GPU where there is one. Used on this thread only, if it is a GPU's. \param planes
/// measures the error as Eq. 6.2 prints it, too
[[nodiscard]] ChosenEngine smoothing_engine(const SmoothingSubject& subject,
                                            const Arguments& arguments, bool planes);

/// \param engine that goes through the space
/// \param all_parameters for graphs
[[nodiscard]] SearchSpace smoothing_space_for(const SmoothingSubject& subject,
                                              const SmoothingEngine& engine, bool all_parameters);

/// The arguments of `smooth` as a set of that space.
[[nodiscard]] ParameterSet smoothing_set(const SmoothingSubject& subject,
                                         const Arguments& arguments, const SearchSpace& space);

/// The surface smoothed with a set, as `smooth` does it but for walls that would cross.
/// \throw InvalidInput if the space leaves the set out; Cancelled
[[nodiscard]] Surface smoothed_with(const SmoothingSubject& subject, const Surface& surface,
                                    const SearchSpace& space, const ParameterSet& set,
                                    const Progress& progress);

}  // namespace vesselbench
