#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/gpu_engine.h"
#include "smoothing/quality/smoothing_space.h"
#include "workbench/case/arguments.h"

namespace vesselbench {

/// What a search needs of an operation that filters a surface (OperationSearch::smoothing): its
/// filter and the filter's inputs on a scene, at the given arguments.
struct SmoothingSubject {
    FilterParameters filter;
    int iterations = 0;
    StaircaseValues thresholds;
    DeviceChoice device = DeviceChoice::Auto;  ///< of the search
    FilterGround ground;
    std::shared_ptr<const std::vector<double>> weights;  ///< at the given arguments; null: all 1
    StaircaseWeights staircase;  ///< of other thresholds; null: they do not count
    std::optional<StaircaseGround> staircase_ground;  ///< the GPU's inputs for the same
    bool mu_stays = false;                            ///< of Taubin's filter: the user gave it
    double slice = 1.0;                               ///< about the distance of slices [mm]
    /// Arguments that follow the searched ones, because they are not given.
    std::vector<std::string> followers;
    std::function<void(Arguments&)> decide;  ///< fills in absent followers; null without any
};

}  // namespace vesselbench
