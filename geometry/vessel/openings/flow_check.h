#pragma once

#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// What a flow needs of a plan: two openings, and no end without an opening, unless it is a sac or
/// stays closed as asked, that is wider than all of them (kAsLarge).
/// \throw AlgorithmFailure that lists all ends with their reasons
void check_flow(const OpeningPlan& plan);

/// The same. The failure names the arguments of clip-opening that go on, which were tried.
/// \param options that made the plan
void check_flow(const OpeningPlan& plan, const Surface& surface, const CenterlineGraph& graph,
                const OpeningPlanOptions& options);

/// How to leave ends closed on purpose: "closed=1,2,3 ..." and the same for prepare.
/// \param closed all of them
[[nodiscard]] std::string closing_advice(const Positions& closed);

}  // namespace vesselbench
