#include "geometry/vessel/narrowing/named_narrowing.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"

namespace vesselbench {

namespace {

constexpr double kFar = 3.0;   ///< from the axis: a point that means no place of the vessel [radii]
constexpr double kNear = 1.0;  ///< a point so far beyond a narrowing's ends still means it [radii]

Diagnostic refusal(const char* code, const Vec3& place) {
    return {.code = code, .operation = "correct-narrowing", .place = place};
}

/// The narrowing whose stretch holds the place of its branch.
std::optional<Narrowing> holding(const std::vector<Narrowing>& found, const BranchPlace& place) {
    const auto holds = [&](const Narrowing& n) {
        const double near = kNear * n.expected_radius;
        return n.branch == place.branch && place.abscissa >= n.from - near &&
               place.abscissa <= n.to + near;
    };
    const auto it = std::ranges::find_if(found, holds);
    return it == found.end() ? std::nullopt : std::optional(*it);
}

/// There is none: names the nearest one, if there is one.
Diagnostic none_at(const Vec3& at, const std::vector<Narrowing>& found) {
    Diagnostic none = refusal("no-narrowing-there", at);
    if (found.empty()) return none;
    const auto nearest = std::ranges::min_element(
        found, {}, [&](const Narrowing& n) { return (n.place - at).norm(); });
    none.remedies = {{.arguments = {{"at", coordinates_argument(nearest->place)}}}};
    return none;
}

}  // namespace

NamedNarrowing narrowing_at(const Surface& surface, const NarrowingQuestion& question,
                            const Progress& progress) {
    NamedNarrowing named;
    named.graph = centerlines_of(surface, {}, progress.part(0.0, 0.8));
    const auto nearest = nearest_place(*named.graph, question.at);
    if (!nearest) throw DiagnosedFailure(refusal("no-narrowing-there", question.at));
    const std::size_t b = nearest->place.branch;
    const CenterlineBranch& branch = named.graph->branches[b];
    if (nearest->distance > kFar * radius_at(branch, nearest->place.abscissa)) {
        Diagnostic off = refusal("narrowing-off-vessel", question.at);
        off.figures = {{"distance_mm", nearest->distance}};
        throw DiagnosedFailure(off);
    }
    named.rings = wall_rings(surface, *named.graph, b, progress.part(0.8, 0.85));
    const double s = nearest->place.abscissa;
    if (named.rings.empty() || s < named.rings.front().along || s > named.rings.back().along)
        throw DiagnosedFailure(refusal("narrowing-at-branch-end", question.at));
    std::optional<Narrowing> meant;
    if (!question.from || !question.to) {
        const auto found =
            find_narrowings(surface, *named.graph, question.parameters, progress.part(0.85, 1.0));
        meant = holding(found, nearest->place);
        if (!meant) throw DiagnosedFailure(none_at(question.at, found));
    }
    named.from = question.from.value_or(meant ? point_at(branch, meant->from) : question.at);
    named.to = question.to.value_or(meant ? point_at(branch, meant->to) : question.at);
    double from = nearest_place(*named.graph, b, named.from)->place.abscissa;
    double to = nearest_place(*named.graph, b, named.to)->place.abscissa;
    if (from > to) std::swap(from, to);
    const auto between = from < to ? narrowing_between(named.rings, b, from, to) : std::nullopt;
    if (!between) throw DiagnosedFailure(refusal("narrowing-without-vessel", question.at));
    named.narrowing = *between;
    return named;
}

}  // namespace vesselbench
