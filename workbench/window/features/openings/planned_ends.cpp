#include "workbench/window/features/openings/planned_ends.h"

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <limits>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/operations/clip_opening/clipping.h"
#include "workbench/operations/clip_opening/parameters.h"

namespace vesselbench {

namespace {

constexpr double kReach = 2.0;      ///< a point so far away does not mean an end [diameters]
constexpr double kSameEnd = 1.0;    ///< an end whose line was added is the same end [diameters]
constexpr double kSamePlace = 0.5;  ///< of a closing and its end [diameters]

Arguments without(Arguments arguments, std::initializer_list<const char*> names) {
    for (const char* name : names) arguments.remove(name);
    return arguments;
}

bool is_rim_or_cap(const OpeningPlan& plan, const EndRecord& end) {
    if (end.rim || end.border) return true;
    if (end.opening && plan.openings[*end.opening].way != OpeningWay::Cut) return true;
    return std::ranges::any_of(plan.closings, [&](const PlannedClosing& closing) {
        return closing.way != ClosingWay::RemoveStub &&
               (closing.place - end.place).norm() < kSamePlace * end.diameter;
    });
}

/// True if a tip of the lines is the end, on a branch that leaves a wider vessel.
bool is_branch(const CenterlineGraph& graph, const EndRecord& end) {
    const auto tip = nearest_tip(graph, end.place);
    return tip && (graph.nodes[*tip].position - end.place).norm() < kSameEnd * end.diameter &&
           blind_branch(graph, *tip) && !is_trunk(graph, *tip);
}

/// The removal goes by the centerlines of the whole surface: an end that these do not reach cannot
/// be removed, and neither can one without a furcation.
std::vector<bool> removable_ends(const Surface& surface, const OpeningPlan& plan,
                                 const Progress& progress) {
    std::vector<bool> removable(plan.ends.size(), false);
    try {
        const auto graph = centerlines_of(surface, {}, progress);
        for (std::size_t e = 0; e < plan.ends.size(); ++e)
            removable[e] = !is_rim_or_cap(plan, plan.ends[e]) && is_branch(*graph, plan.ends[e]);
    } catch (const AlgorithmFailure&) {  // without lines there are no branches
    }
    return removable;
}

std::shared_ptr<const PlainEnds> plain_ends(const Operation& operation, const Scene& scene,
                                            const Arguments& given, const Progress& progress) {
    PlainEnds ends;
    ends.plan = planned_openings(scene, checked_arguments(operation, plain_arguments(given)),
                                 progress.part(0.0, 0.8));
    ends.removable = removable_ends(surface_of(scene), ends.plan, progress.part(0.8, 1.0));
    return std::make_shared<const PlainEnds>(std::move(ends));
}

const PlannedOpening* opening_in(const OpeningPlan& plan, const EndRecord& end) {
    return end.opening ? &plan.openings[*end.opening] : nullptr;
}

}  // namespace

const EndRecord* PlainEnds::end(int number) const {
    const auto found = std::ranges::find(plan.ends, number, &EndRecord::number);
    return found == plan.ends.end() || number == 0 ? nullptr : &*found;
}

const EndRecord& PlannedEnds::decided(const EndRecord& end) const {
    if (!chosen || chosen->ends.empty()) return end;
    const EndRecord& nearest = *std::ranges::min_element(
        chosen->ends, {}, [&](const EndRecord& other) { return (other.place - end.place).norm(); });
    return (nearest.place - end.place).norm() < kSameEnd * end.diameter ? nearest : end;
}

const PlannedOpening* PlannedEnds::opening(int number) const {
    const EndRecord* end = plain->end(number);
    if (end == nullptr) return nullptr;
    const EndRecord& now = decided(*end);
    if (&now != end && now.opening) return opening_in(*chosen, now);
    return opening_in(plain->plan, *end);
}

std::optional<int> PlannedEnds::number_at(const Vec3& point) const {
    std::optional<int> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const EndRecord& end : plain->plan.ends) {
        if (end.number == 0) continue;
        double distance = (end.place - point).norm();
        if (const PlannedOpening* open = opening(end.number))
            distance = std::min(distance, (open->place.tip - point).norm());
        if (distance >= least || distance > kReach * end.diameter) continue;
        least = distance;
        nearest = end.number;
    }
    return nearest;
}

Arguments planning_arguments(Arguments given) {
    return without(std::move(given), {"planes", "names", "closings"});
}

Arguments plain_arguments(Arguments given) {
    Arguments plain = planning_arguments(std::move(given));
    for (const NumberParameter& parameter : kNumberParameters)
        plain = without(std::move(plain), {parameter.numbers, parameter.places});
    return plain;
}

PlannedEnds plan_ends(const Operation& operation, const Scene& scene, const Arguments& given,
                      std::shared_ptr<const PlainEnds> known, const Progress& progress) {
    PlannedEnds planned{.plain = std::move(known), .chosen = {}, .problem = {}};
    if (!planned.plain)
        planned.plain = plain_ends(operation, scene, given, progress.part(0.0, 0.5));
    const Arguments asked = planning_arguments(given);
    if (asked == plain_arguments(given)) {
        planned.chosen = {planned.plain, &planned.plain->plan};
        return planned;
    }
    try {
        planned.chosen = std::make_shared<const OpeningPlan>(
            planned_openings(scene, checked_arguments(operation, asked), progress.part(0.5, 1.0)));
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& failure) {
        planned.problem = failure.what();
    }
    return planned;
}

}  // namespace vesselbench
