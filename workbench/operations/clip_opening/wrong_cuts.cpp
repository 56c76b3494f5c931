#include "workbench/operations/clip_opening/wrong_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

namespace {

/// The place of a plan that has to go so that a vessel stays: its stub, or the cut next to it.
/// \throw AlgorithmFailure if there is neither
FailedCut cut_that_lost(const OpeningPlan& plan, const LostVessel& lost) {
    FailedCut failed{
        .why = {.code = "cut-loses-vessel",
                .place = lost.place,
                .figures = {{"length_mm", lost.length}, {"diameter_mm", lost.diameter}}},
        .lost = true};
    for (const PlannedClosing& closing : plan.closings)
        if (closing.way == ClosingWay::RemoveStub &&
            (closing.place - lost.tip).norm() < 0.5 * lost.diameter) {
            failed.tip = failed.place = closing.place;
            return failed;
        }
    double least = std::numeric_limits<double>::infinity();
    for (const PlannedOpening& opening : plan.openings) {
        const double distance = (opening.place.plane.point - lost.root).norm();
        if (opening.way != OpeningWay::Cut || distance >= least) continue;
        least = distance;
        failed.tip = opening.place.tip;
        failed.place = opening.place.plane.point;
    }
    if (std::isinf(least)) throw DiagnosedFailure(failed.why);
    return failed;
}

}  // namespace

void require_most_kept(const Surface& before, const Surface& after) {
    constexpr double kLeastKept = 0.5;
    if (!before.topology->boundary_loops().empty()) return;
    const double kept = std::abs(volume(after) / volume(before));
    if (kept < kLeastKept)
        throw DiagnosedFailure({.code = "cuts-take-model",
                                .figures = {{"volume_percent", 100.0 * (1.0 - kept)}},
                                .remedies = {{.arguments = {{"tip", ""}}}}});
}

std::vector<FailedCut> wrong_cuts(const Surface& before, const CenterlineGraph& vessels,
                                  const OpeningPlan& plan, const Surface& after) {
    std::vector<FailedCut> wrong;
    if (plan.openings.empty()) return wrong;
    for (const std::size_t patch : openings_in_walls(before, after)) {
        const Vec3 at = patch_shape(after, patch).plane.point;
        const auto opening = std::ranges::min_element(
            plan.openings, {},
            [&](const PlannedOpening& o) { return (o.place.plane.point - at).norm(); });
        wrong.push_back({opening->place.tip, opening->place.plane.point,
                         Diagnostic{.code = "opening-would-lie-in-wall", .place = at}});
    }
    const std::vector<LostVessel> lost = lost_vessels(vessels, after);
    if (lost.empty() || !lost_vessels(vessels, before).empty()) return wrong;  // lines lie outside
    for (const LostVessel& vessel : lost)
        if (vessel.matters()) wrong.push_back(cut_that_lost(plan, vessel));
    return wrong;
}

}  // namespace vesselbench
