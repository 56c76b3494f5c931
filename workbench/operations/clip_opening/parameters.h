#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/vessel/openings/openings.h"
#include "workbench/case/arguments.h"
#include "workbench/case/parameter.h"

namespace vesselbench {

/// The operation's parameters: what to open, and what an earlier run decided.
[[nodiscard]] std::vector<Parameter> clip_opening_parameters();

/// A parameter that names ends by their numbers, and the one that names the same by places.
struct NumberParameter {
    const char* numbers;
    const char* places;
    Positions OpeningPlanOptions::*into;
};

inline constexpr std::array<NumberParameter, 3> kNumberParameters = {
    {{"inlet_ends", "inlet", &OpeningPlanOptions::inlets},
     {"open_ends", "open", &OpeningPlanOptions::open},
     {"close_ends", "closed", &OpeningPlanOptions::closed}}};

/// Values of `vessel`. The blood of a portal vein enters at its trunk, as in an artery.
inline constexpr const char *kArtery = "artery", *kVein = "vein", *kPortalVein = "portal";

/// True if the blood gathers, as in a vein: all ends but the trunk's are inlets.
[[nodiscard]] bool gathers(const Arguments& arguments);

/// Ends that are named by their numbers, by the places that a run found for these: on another input
/// the numbers are those of other ends.
[[nodiscard]] Arguments with_found_places(Arguments given, const Arguments& resolved);

[[nodiscard]] bool names_numbers(const Arguments& arguments);

/// \throw UsageError if arguments contradict each other, or points have too few numbers
void check_clip_arguments(const Arguments& arguments);

/// The points of a list, three numbers each; empty if it is not given.
[[nodiscard]] Positions points_of(const Arguments& arguments, const char* name);

/// What the arguments ask of a plan.
/// \param image that the surface was made from
[[nodiscard]] OpeningPlanOptions plan_options(const Arguments& arguments,
                                              const std::optional<Image>& image);

}  // namespace vesselbench
