#pragma once

#include <string>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "geometry/vessel/openings/openings.h"

namespace vesselbench {

/// What a plan lacks for a flow, with a list of all ends and their reasons; empty: nothing. A flow
/// needs two openings. An end with a share of the flow (kLeastShare) must not be missing, unless it
/// is asked for or certain to be a sac or a bump; nor may the odds of one be in doubt (EndLimits).
[[nodiscard]] std::string why_no_flow(const OpeningPlan& plan, bool accept_doubts = false);

/// \param options that made the plan
/// \throw DiagnosedFailure with one diagnostic for each end, which has why_no_flow and the arguments of
/// clip-opening that go on;
/// they were tried, which takes as long as several plans; Cancelled
void check_flow(const OpeningPlan& plan, const Surface& surface, const CenterlineGraph& graph,
                const OpeningPlanOptions& options, const Progress& progress = {});

/// Leaves ends closed on purpose: clip-opening closed=1,2,3, with all ends that are named.
[[nodiscard]] Remedy closing_remedy(const OpeningPlanOptions& options);

}  // namespace vesselbench
