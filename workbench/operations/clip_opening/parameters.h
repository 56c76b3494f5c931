#pragma once

#include <optional>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/vessel/openings/openings.h"
#include "workbench/case/arguments.h"
#include "workbench/case/parameter.h"

namespace vesselbench {

/// The operation's parameters: what to open, and what an earlier run decided.
[[nodiscard]] std::vector<Parameter> clip_opening_parameters();

/// \throw UsageError if arguments contradict each other, or points have too few numbers
void check_clip_arguments(const Arguments& arguments);

/// The points of a list, three numbers each; empty if it is not given.
[[nodiscard]] Positions points_of(const Arguments& arguments, const char* name);

/// What the arguments ask of a plan.
/// \param image that the surface was made from
[[nodiscard]] OpeningPlanOptions plan_options(const Arguments& arguments,
                                              const std::optional<Image>& image);

}  // namespace vesselbench
