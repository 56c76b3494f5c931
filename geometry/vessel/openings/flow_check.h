#pragma once

#include <string>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// Diameter of the widest end with an opening [mm]; 0: there is none.
[[nodiscard]] double widest_opening(const OpeningPlan& plan);

/// What a plan lacks for a flow, with a list of all ends and their reasons; empty: nothing. A flow
/// needs two openings, and no end without one, unless it is a sac, has no centerline or is asked
/// for, that is wider than all of them (kAsLarge), nor an open rim that is large (kLargeEnd), nor
/// the rest of a chamber that is twice as wide as all of them: its mouth may be closed there.
[[nodiscard]] std::string why_no_flow(const OpeningPlan& plan);

/// \param options that made the plan
/// \throw AlgorithmFailure that says why_no_flow and names the arguments of clip-opening that go on;
/// they were tried, which takes as long as several plans; Cancelled
void check_flow(const OpeningPlan& plan, const Surface& surface, const CenterlineGraph& graph,
                const OpeningPlanOptions& options, const Progress& progress = {});

/// How to leave ends closed on purpose: "closed=1,2,3 ..." and the same for prepare.
/// \param closed all of them
[[nodiscard]] std::string closing_advice(const Positions& closed);

}  // namespace vesselbench
