#include "geometry/vessel/openings/end_opener.h"

#include <algorithm>
#include <optional>

#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/place_warnings.h"
#include "geometry/vessel/openings/rim_and_cap_places.h"

namespace vesselbench {

namespace {

/// A cut farther from its tip [diameters], or the removal of a longer stub, would lose a vessel
/// (lost_vessels).
constexpr double kMostGivenUp = 2.8;
/// A narrower rim beside its vessel is a hole in the end [-].
constexpr double kLeastKept = 0.5;
/// A branch that is longer than this [diameters] is cut on its own side of the furcation only.
constexpr double kLongestAcross = 3.0;

/// The cut that failed there before; null: there is none.
const FailedCut* failure_at(const PlanDraft& draft, std::size_t e, const Vec3& place) {
    const std::vector<FailedCut>& all = draft.options().failed;
    const double same = 1e-6 * (1.0 + draft.ends()[e].diameter);
    const Vec3 tip = draft.tip_place(e);
    const auto found = std::ranges::find_if(all, [&](const FailedCut& failed) {
        const double beyond = (place - tip).norm() - (failed.place - tip).norm();
        return (failed.place - place).norm() < same ||
               (failed.lost && (failed.tip - tip).norm() < same && beyond > -same);
    });
    return found == all.end() ? nullptr : &*found;
}

bool has_failed(const PlanDraft& draft, std::size_t e, const Vec3& place) {
    return failure_at(draft, e, place) != nullptr;
}

/// The distance of the cut that was asked for [mm].
std::optional<double> distance_asked(const PlanDraft& draft, std::size_t tip) {
    const OpeningPlanOptions& options = draft.options();
    if (options.distance) return options.distance;
    if (options.radii) return *options.radii * tip_radius(draft.graph(), tip);
    return std::nullopt;
}

std::string fray_text(const FrayedTrunk& trunk) {
    double widest = 0.0;
    for (const ThinEnd& thread : trunk.ends) widest = std::max(widest, thread.diameter);
    return "the lumen splits there into " + std::to_string(trunk.ends.size()) +
           " strands of at most " + formatted(widest) + " mm, which were cut off";
}

}  // namespace

EndOpener::EndOpener(PlanDraft& draft, const Progress& progress)
    : draft_(draft),
      progress_(progress),
      trials_(draft.surface(), draft.graph(), draft.ends(), draft.courses()) {}

bool EndOpener::keep(std::size_t e) {
    if (draft_.is_fixed()) return false;
    const auto place = kept_place(draft_, e);
    if (!place || has_failed(draft_, e, place->plane.point) ||
        (!draft_.ends()[e].patch && place->diameter < kLeastKept * draft_.ends()[e].diameter))
        return false;
    const bool cap = draft_.ends()[e].patch.has_value();
    std::string why = cap ? "its flat cap was kept" : "its flat rim was capped as it is";
    if (const std::string tilt = tilt_text(*place); !tilt.empty()) why += ", " + tilt;
    draft_.open(e, *place, cap ? OpeningWay::KeepCap : OpeningWay::CapRim, why);
    draft_.record(e).plain = true;
    trials_.protect(draft_.ends()[e]);
    return true;
}

bool EndOpener::cut(std::size_t e) {
    if (cut_across(e)) return true;
    if (draft_.options().strict || draft_.is_fixed() || (is_stub(e) && !draft_.has_share(e)))
        return false;
    const std::string why = draft_.record(e).why;
    const auto place = place_along_rim(draft_, e);
    if (place && is_free(*place, e)) return make_cut(e, *place, "cut along its rim: " + why);
    draft_.record(e).why = why;
    return keep_bent(e) || keep_oblique(e);
}

bool EndOpener::is_stub(std::size_t e) const {
    const SurfaceEnd& end = draft_.ends()[e];
    const CenterlineGraph& graph = draft_.graph();
    if (!end.tip || end.patch || has_failed(draft_, e, graph.nodes[*end.tip].position))
        return false;
    const auto blind = blind_branch(graph, *end.tip);
    return blind && blind->is_stub() && blind->length < kMostGivenUp * end.diameter;
}

/// Cuts an end at the chosen place, else at the nearest one that can be cut. False: there is none,
/// and the record says why.
bool EndOpener::cut_across(std::size_t e) {
    const SurfaceEnd& end = draft_.ends()[e];
    EndRecord& record = draft_.record(e);
    if (!end.tip) {
        record.why = end.patch ? "its cap is not flat, and no vessel's tip is there"
                               : "its rim is not flat, and no vessel's tip is there";
        return false;
    }
    try {
        const OpeningPlace place = choose_opening_place(draft_.surface(), draft_.graph(), *end.tip,
                                                        distance_asked(draft_, *end.tip));
        const FrayedTrunk* frayed = draft_.frays(e);
        if (is_free(place, e))
            return make_cut(e, place, frayed ? fray_text(*frayed) : end_problem(draft_, e),
                            !frayed);
    } catch (const AlgorithmFailure& failure) {
        record.why = failure.what();
    }
    return !draft_.options().strict && !draft_.is_fixed() && cut_elsewhere(e);
}

/// Cuts an end that cannot be cut at its chosen place, for the reason in its record.
bool EndOpener::cut_elsewhere(std::size_t e) {
    const SurfaceEnd& end = draft_.ends()[e];
    const Surface& surface = draft_.surface();
    const CenterlineGraph& graph = draft_.graph();
    const auto free = [&](const OpeningPlace& place) { return is_free(place, e); };
    const auto near = [&](const OpeningPlace& place) {
        return place.distance < kMostGivenUp * place.diameter && free(place);
    };
    const std::string why = draft_.record(e).why;
    if (const auto place = nearest_opening_place(surface, graph, *end.tip, near))
        return make_cut(e, *place, "cut at the nearest possible place: " + why);
    const auto blind = blind_branch(graph, *end.tip);
    if (blind && blind->length < kLongestAcross * end.diameter)
        if (const auto place = place_across_furcation(surface, graph, *end.tip, free))
            return make_cut(e, *place, "cut across its furcation: " + why);
    draft_.record(e).why = why;
    return false;
}

/// The last resort at an open rim: a vessel ends there, though no cut behind it is whole.
bool EndOpener::keep_bent(std::size_t e) {
    const auto place = bent_rim_place(draft_, e);
    if (!place || has_failed(draft_, e, place->plane.point)) return false;
    draft_.open(e, *place, OpeningWay::CapRim,
                "its rim was bent into a plane and capped: " + draft_.record(e).why);
    trials_.protect(draft_.ends()[e]);
    return true;
}

/// The last resort at an image's border: a vessel ends there, even if its furcation is so near
/// that no place for a cut across it is left.
bool EndOpener::keep_oblique(std::size_t e) {
    const SurfaceEnd& end = draft_.ends()[e];
    if (!draft_.record(e).border || !end.tip || !trials_.is_whole_cap(end)) return false;
    const auto place = oblique_cap_place(draft_, e);
    if (!place || has_failed(draft_, e, place->plane.point)) return false;
    draft_.open(e, *place, OpeningWay::KeepCap,
                "its cap at the image's border was kept, though it is not perpendicular to the "
                "vessel: " +
                    draft_.record(e).why);
    trials_.protect(end);
    return true;
}

/// False: a cut cannot be made there, and the record says why.
bool EndOpener::is_free(const OpeningPlace& place, std::size_t e) {
    progress_.check_cancelled();
    if (const FailedCut* failed = failure_at(draft_, e, place.plane.point)) {
        draft_.record(e).why = text_of(failed->why);
        return false;
    }
    if (draft_.options().tip && draft_.is_fixed()) return true;  // as the user says
    const std::string problem = trials_.problem_of(place, e);
    if (problem.empty()) return true;
    draft_.record(e).why = "the branch with its tip at " + place_text(place.tip) + ": " + problem;
    return false;
}

/// \param chosen at the chosen place
bool EndOpener::make_cut(std::size_t e, const OpeningPlace& place, const std::string& why,
                         bool chosen) {
    draft_.open(e, place, OpeningWay::Cut, why);
    draft_.record(e).plain = chosen;
    if (draft_.options().tip && draft_.is_fixed()) return true;
    for (const std::size_t other : trials_.taken_along()) draft_.take_along(other, e);
    trials_.take();
    return true;
}

}  // namespace vesselbench
