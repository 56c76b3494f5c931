#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vessel/openings/plan_draft.h"

namespace vesselbench {

/// True if ends that are closed may be openings. Open rims and named caps determine the vessel
/// ends. Cuts at an image's border do not: other vessels may end inside the image. Nor does a
/// single end: blood has to enter and leave.
[[nodiscard]] bool opens_blind_ends(const PlanDraft& draft);

/// By end, why it may be none though a centerline ends there; empty: there is no doubt.
[[nodiscard]] std::vector<std::string> doubts_about_ends(const PlanDraft& draft);

/// Two others are open, and one of them is wider: the flow does not need the end.
[[nodiscard]] bool is_spare(const PlanDraft& draft, std::size_t e);

/// A blind branch beside open rims is an end after all if it is the widest one and no sac: long,
/// or a trunk.
[[nodiscard]] bool is_wider_than_all(const PlanDraft& draft, std::size_t e);

/// Why a closed end is none.
struct ClosedLook {
    std::string why;
    bool sac = false;  ///< it counts as an aneurysm, however wide
};

/// An aneurysm stays closed, as does a branch too short to be opened. If an image's border already
/// provides inflow and outflow, a short blind stub is not an opening either; if flat caps do, and
/// are all of the vessel's other ends, a knob is none. Empty for all other ends.
[[nodiscard]] std::optional<ClosedLook> looks_closed(const PlanDraft& draft, std::size_t e);

}  // namespace vesselbench
