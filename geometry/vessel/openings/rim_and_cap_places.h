#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "geometry/vessel/openings/plan_draft.h"

namespace vesselbench {

/// The plane of an end's own rim or cap, if that is good enough to be kept as it is.
/// \param e an end with a rim or a cap
[[nodiscard]] std::optional<OpeningPlace> kept_place(const PlanDraft& draft, std::size_t e);

/// Why a rim or cap is not kept; empty if the end has none, or the place of the cuts was given.
[[nodiscard]] std::string end_problem(const PlanDraft& draft, std::size_t e);

/// The plane of a cap at an image's border that is flat, but not perpendicular to its vessel.
/// Empty if it is not flat, or only grazes a bulge.
/// \param e an end with a cap
[[nodiscard]] std::optional<OpeningPlace> oblique_cap_place(const PlanDraft& draft, std::size_t e);

/// Just behind an open rim, in the direction of its own plane. Empty: the end has none, or one
/// that is hardly a vessel's end.
[[nodiscard]] std::optional<OpeningPlace> place_along_rim(const PlanDraft& draft, std::size_t e);

/// A rim that can be capped in its own plane where nothing behind it can be cut, as where two rims
/// lie at one furcation; empty: it is too far from a plane, or no vessel's end.
[[nodiscard]] std::optional<OpeningPlace> bent_rim_place(const PlanDraft& draft, std::size_t e);

}  // namespace vesselbench
