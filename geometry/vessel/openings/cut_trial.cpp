#include "geometry/vessel/openings/cut_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_section.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/rim_shape.h"

namespace vesselbench {

namespace {

/// A cut through a vessel's side is longer than its own vessel is wide, or a slit.
constexpr double kWidestSection = 2.0;  ///< diameter over that of an inscribed circle
constexpr double kLeastRoundness = 0.3;
/// A cut of a closed end is at least so wide beside its vessel [-].
constexpr double kLeastWidth = 0.4;
/// What a cut may remove beyond its tip [diameters].
constexpr double kLongestLoss = 3.0;
/// An open rim this wide beside a cut [-] is an end of its own, unless both were torn off one end:
/// they face the same way within this angle [deg], and are this close [sums of their diameters].
constexpr double kWideRim = 0.5;
constexpr double kOneEndDeg = 60.0;
constexpr double kOneEndReach = 0.75;
/// A thread beside an end, by the diameters of their vessels [-]: 2 % of its flow.
constexpr double kThread = 0.27;
/// Tips this close together may belong to one ragged end [diameters of the cut].
constexpr double kSameEnd = 2.0;

}  // namespace

CutTrials::CutTrials(const Surface& surface, const CenterlineGraph& graph,
                     const std::vector<SurfaceEnd>& ends, std::vector<double> courses)
    : surface_(surface),
      graph_(graph),
      ends_(ends),
      courses_(std::move(courses)),
      use_(surface.vertex_count(), Use::Free),
      seen_(surface.vertex_count(), 0) {}

std::string CutTrials::shape_problem(const SectionCurve& curve, const OpeningPlace& place) const {
    if (rise_deg(surface_, curve, place.plane) < kLeastRiseDeg)
        return "a cut there would open the vessel's side";
    const double roundness =
        4.0 * std::numbers::pi * std::abs(curve.area) / (curve.perimeter * curve.perimeter);
    const auto line = nearest_place(graph_, place.plane.point);
    const double radius =
        line ? radius_at(graph_.branches[line->place.branch], line->place.abscissa) : 0.0;
    if (roundness < kLeastRoundness ||
        (radius > 0.0 && curve.diameter() > 2.0 * kWidestSection * radius))
        return "a cut there would run along the vessel";
    return "";
}

/// A thread at a vessel's closed end, such as a speck of noise, is no vessel: the line runs through
/// it to its tip, but the end is that of the vessel. A section that is much wider is another
/// vessel's, such as the one that a branch leaves.
std::string CutTrials::width_problem(const OpeningPlace& place, std::size_t end) const {
    const double least = ends_[end].is_visible() ? 0.0 : kLeastWidth * courses_[end];
    const bool too_wide = courses_[end] > 0.0 && place.diameter > kWidestSection * courses_[end];
    if (!too_wide && !(place.diameter < least)) return "";
    return "a cut there would be " + formatted(place.diameter) + " mm wide, but the vessel is " +
           formatted(courses_[end]) + " mm wide";
}

std::string CutTrials::flood(const SectionCurve& curve) {
    using Edge = std::pair<VertexId, VertexId>;
    std::set<Edge> crossed;
    std::set<VertexId> below;
    ++trial_;
    removed_.clear();
    for (const SectionCrossing& crossing : curve.crossings) {
        crossed.emplace(crossing.above, crossing.below);
        below.insert(crossing.below);
        if (std::exchange(seen_[crossing.above], trial_) != trial_)
            removed_.push_back(crossing.above);
    }
    const CompressedRows& rings = surface_.topology->rings();
    for (std::size_t i = 0; i < removed_.size(); ++i) {
        const VertexId v = removed_[i];
        if (use_[v] != Use::Free) return "a cut there would remove another opening";
        for (const VertexId next : rings.row(v)) {
            if (seen_[next] == trial_) continue;
            if (below.contains(next)) {
                if (crossed.contains({v, next})) continue;
                return "a cut there does not separate the branch from the rest: the vessels form "
                       "a loop there";
            }
            seen_[next] = trial_;
            removed_.push_back(next);
        }
    }
    return "";
}

bool CutTrials::is_own_rim(const OpeningPlace& place, std::size_t end, std::size_t other) const {
    if (ends_[other].rim.empty()) return false;
    const RimShape rim = rim_shape(surface_, ends_[other].rim);
    if (rim.diameter() < kWideRim * place.diameter) return false;
    if (ends_[end].rim.empty()) return true;
    const RimShape cut = rim_shape(surface_, ends_[end].rim);
    return angle_deg(rim.plane.normal, cut.plane.normal) > kOneEndDeg ||
           (rim.plane.point - cut.plane.point).norm() >
               kOneEndReach * (rim.diameter() + cut.diameter());
}

/// A tip that may go with another one's end: near it, and of a branch that is hardly one.
bool CutTrials::is_ragged_tip(const OpeningPlace& place, std::size_t other) const {
    const SurfaceEnd& end = ends_[other];
    if (!end.tip) return true;  // a hole in the wall
    const Vec3& tip = graph_.nodes[*end.tip].position;
    if ((tip - place.tip).norm() > kSameEnd * std::max(place.diameter, end.diameter)) return false;
    const auto blind = blind_branch(graph_, *end.tip);
    return blind && blind->length < kLongestLoss * end.diameter;
}

/// A vessel that carries next to nothing beside the end's own must not cost the end.
bool CutTrials::is_thread(const OpeningPlace& place, std::size_t end, std::size_t other) const {
    return !ends_[other].is_visible() && courses_[other] > 0.0 &&
           courses_[other] < kThread * courses_[end] &&
           (ends_[other].centre - place.tip).norm() < kSameEnd * courses_[end];
}

std::string CutTrials::lost_problem(const OpeningPlace& place, std::size_t end) {
    taken_along_.clear();
    for (std::size_t e = 0; e < ends_.size(); ++e) {
        if (e == end || seen_[ends_[e].vertex] != trial_) continue;
        if (is_own_rim(place, end, e) || !(is_ragged_tip(place, e) || is_thread(place, end, e)))
            return "a cut there would remove the vessel's end at " + place_text(ends_[e].centre) +
                   ", too";
        taken_along_.push_back(e);
    }
    double farthest = 0.0;
    for (const VertexId v : removed_)
        farthest = std::max(farthest, (surface_.points()[v] - place.plane.point).norm());
    if (farthest > place.distance + kLongestLoss * place.diameter)
        return "a cut there would remove vessels up to " + formatted(farthest, "%.1f") + " mm away";
    return "";
}

std::string CutTrials::problem_of(const OpeningPlace& place, std::size_t end) {
    const auto curve = whole_section_at(surface_, place.plane);
    if (!curve) return "there is no closed section";
    if (curve->area <= 0.0 && volume(surface_) > 0.0) return "the wall lies inside out there";
    strip_.clear();
    for (const TriangleId t : curve->triangles) {
        if (surface_.patch_of(t).kind != PatchKind::Wall) return "a cut there would meet a cap";
        for (const VertexId v : surface_.triangles()[t]) {
            if (use_[v] != Use::Free) return "a cut there would meet another opening";
            strip_.push_back(v);
        }
    }
    std::string problem = shape_problem(*curve, place);
    if (problem.empty()) problem = width_problem(place, end);
    if (problem.empty()) problem = flood(*curve);
    if (problem.empty()) problem = lost_problem(place, end);
    return problem;
}

void CutTrials::take() {
    for (const VertexId v : removed_) use_[v] = Use::Gone;
    for (const VertexId v : strip_) use_[v] = Use::Guarded;
}

bool CutTrials::is_whole_cap(const SurfaceEnd& end) const {
    for (TriangleId t = 0; end.patch && t < surface_.triangle_count(); ++t)
        if ((*surface_.patch_labels)[t] == *end.patch)
            for (const VertexId v : surface_.triangles()[t])
                if (use_[v] == Use::Gone) return false;
    return end.patch.has_value();
}

void CutTrials::protect(const SurfaceEnd& end) {
    for (const VertexId v : end.rim) use_[v] = Use::Guarded;
    if (!end.patch) return;
    for (TriangleId t = 0; t < surface_.triangle_count(); ++t)
        if ((*surface_.patch_labels)[t] == *end.patch)
            for (const VertexId v : surface_.triangles()[t]) use_[v] = Use::Guarded;
}

}  // namespace vesselbench
