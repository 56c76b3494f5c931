#pragma once

#include <map>
#include <optional>
#include <string>

#include "smoothing/context/context_finder.h"
#include "workbench/case/arguments.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// How staircases are found on a surface: by the sampling of its image, or as the user says.
struct StaircaseChoice {
    StackAxes axes = Vec3::UnitZ();              ///< unit
    std::string axes_from;                       ///< "argument", "image" or "estimate"
    std::optional<double> confidence;            ///< of an estimated single axis, in [0, 1] [-]
    double tau_theta = 0.0;                      ///< [-]
    double tau_max = 0.0;                        ///< [mm]
    std::map<std::string, std::string> reasons;  ///< by decided argument: "0.498, because ..."

    /// The axes as the argument stack_axis.
    [[nodiscard]] Value axis_value() const;
};

/// Takes stack_axis, tau_theta and tau_max from the arguments, and decides those that are absent by
/// the sampling of the scene's image; of a surface without one, by the voxels that its triangles
/// show.
/// \param finder of the scene's surface; its caps are found only for an estimate
/// \return none if the direction of the stack is uncertain
/// \throw UsageError if stack_axis has no direction; AlgorithmFailure if it is `all`, and the
/// voxels' axes are unknown
/// \pre the scene has a surface
[[nodiscard]] std::optional<StaircaseChoice> staircase_choice(const Scene& scene,
                                                              ContextFinder& finder,
                                                              const Arguments& arguments);

/// \param operation named in the error
/// \throw UsageError if the argument stack_axis has no direction
void check_stack_axis(const Arguments& arguments, const std::string& operation);

}  // namespace vesselbench
