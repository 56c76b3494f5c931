#include "geometry/vessel/openings/openings.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/blind_ends.h"
#include "geometry/vessel/openings/end_opener.h"
#include "geometry/vessel/openings/named_ends.h"
#include "geometry/vessel/openings/plan_draft.h"

namespace vesselbench {

namespace {

/// A point this far from a tip does not mean it [radii of the tip].
constexpr double kFarthestTip = 4.0;

/// The order in which the ends are decided: what is sure first, since each cut limits the later
/// ones.
class Planner {
public:
    Planner(PlanDraft& draft, const Progress& progress)
        : draft_(draft), progress_(progress), opener_(draft, progress) {}

    void plan_one(std::size_t e) {
        if (!opener_.keep(e) && !opener_.cut(e)) throw AlgorithmFailure(draft_.record(e).why);
        draft_.keep_only(e);
    }

    void plan_all() {
        decide_named_ends(draft_);
        for (std::size_t e = 0; e < draft_.ends().size(); ++e) {
            report_decided();
            if (!draft_.is_decided(e) && draft_.ends()[e].is_visible()) opener_.keep(e);
        }
        plan_others();
        require_wanted();
    }

private:
    /// The ends that could not be kept: rims and caps first, doubtful ends last, wider ones before
    /// narrow ones.
    void plan_others() {
        const std::vector<SurfaceEnd>& ends = draft_.ends();
        const bool blind_too = opens_blind_ends(draft_);
        std::vector<std::size_t> order(ends.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, std::greater{},
                                 [&](std::size_t e) { return ends[e].diameter; });
        const std::vector<std::string> doubts = doubts_about_ends(draft_);
        const auto rank = [&](std::size_t e) {
            return ends[e].is_visible() ? 0 : doubts[e].empty() ? 1 : 2;
        };
        for (const int turn : {0, 1, 2})
            for (const std::size_t e : order) {
                report_decided();
                if (!draft_.is_decided(e) && rank(e) == turn)
                    plan_end(e, blind_too || draft_.is_wanted(e), doubts[e]);
            }
    }

    /// \throw Cancelled if the user cancels
    void report_decided() const {
        progress_.report(draft_.decided_share(), "deciding about the ends");
    }

    /// \param doubt why the end may be none; may be empty
    void plan_end(std::size_t e, bool blind_too, const std::string& doubt) {
        const SurfaceEnd& end = draft_.ends()[e];
        if (draft_.stays_side(e) && !draft_.options().strict)
            return draft_.close(e, "it lies in the side of a vessel that passes there");
        if (!end.is_visible() && leaves_closed(e, blind_too)) return;
        if (!doubt.empty() && is_spare(draft_, e)) return draft_.close_offering(e, doubt);
        if (opener_.cut(e)) return;
        if (draft_.options().strict)
            throw AlgorithmFailure(
                "the end at " + place_text(end.centre) + " cannot be cut: " + draft_.record(e).why +
                "; closed=" + coordinates_argument(end.centre) + " leaves it closed on purpose");
        if (!draft_.is_fixed() && opener_.is_stub(e)) return draft_.remove_stub(e);
        draft_.record(e).tried = true;
        draft_.close(e, draft_.record(e).why);
    }

    /// Closes a blind end if the caller, the surface's other ends or its own shape say so.
    bool leaves_closed(std::size_t e, bool blind_too) {
        if (draft_.options().leave_closed && !draft_.is_wanted(e)) {
            draft_.record(e).asked = true;
            draft_.close_offering(e, "closed ends are left as they are");
            return true;
        }
        if (!blind_too && !is_wider_than_all(draft_, e)) {
            const auto blind = blind_branch(draft_.graph(), *draft_.ends()[e].tip);
            draft_.record(e).sac = blind && blind->is_sac();
            draft_.close_offering(e, "a closed end: the surface's own rims are its openings");
            return true;
        }
        if (draft_.is_wanted(e) || draft_.frays(e)) return false;
        const auto look = looks_closed(draft_, e);
        if (!look) return false;
        draft_.record(e).sac = look->sac;
        draft_.close_offering(e, look->why);
        return true;
    }

    /// \throw AlgorithmFailure if an end that was named is not open
    void require_wanted() {
        for (std::size_t e = 0; e < draft_.ends().size(); ++e)
            if (draft_.is_wanted(e) && !draft_.is_open(e))
                throw AlgorithmFailure(std::string("the ") +
                                       (draft_.is_inlet(e) ? "inlet" : "end") + " at " +
                                       place_text(draft_.ends()[e].centre) +
                                       " cannot be opened: " + draft_.record(e).why);
    }

    PlanDraft& draft_;
    const Progress& progress_;
    EndOpener opener_;
};

std::size_t end_of_tip(const std::vector<SurfaceEnd>& ends, std::size_t tip) {
    const auto found = std::ranges::find(ends, std::optional(tip), &SurfaceEnd::tip);
    return found == ends.end() ? 0 : static_cast<std::size_t>(found - ends.begin());
}

}  // namespace

std::string to_string(EndFate fate) {
    switch (fate) {
        case EndFate::Closed:
            return "closed";
        case EndFate::Removed:
            return "removed";
        case EndFate::Opened:
            return "opened";
        case EndFate::Kept:
            return "kept";
    }
    return "";
}

std::size_t tip_to_open(const CenterlineGraph& graph, const Vec3& point) {
    const auto tip = nearest_tip(graph, point);
    if (!tip) throw AlgorithmFailure("the vessels have no tip that could be opened");
    const Vec3& found = graph.nodes[*tip].position;
    if ((found - point).norm() > kFarthestTip * tip_radius(graph, *tip))
        throw AlgorithmFailure("no branch has its tip near " + place_text(point) +
                               "; the nearest one is at " + place_text(found));
    return *tip;
}

LinesWithoutFrays planning_lines(const Surface& surface, const CenterlineGraph& graph,
                                 const OpeningPlanOptions& options) {
    return options.tip ? LinesWithoutFrays{graph, {}} : without_frays(surface, graph);
}

OpeningPlan plan_openings(const Surface& surface, const CenterlineGraph& graph,
                          const OpeningPlanOptions& options, const Progress& progress) {
    return plan_openings(surface, planning_lines(surface, graph, options), options, progress);
}

OpeningPlan plan_openings(const Surface& surface, const LinesWithoutFrays& lines,
                          const OpeningPlanOptions& options, const Progress& progress) {
    PlanDraft draft(surface, lines, options, progress);
    Planner planner(draft, progress);
    if (draft.ends().empty())
        throw AlgorithmFailure(
            "no vessel end that could be opened was found: give one with tip=x,y,z");
    if (options.tip)
        planner.plan_one(end_of_tip(draft.ends(), tip_to_open(lines.graph, *options.tip)));
    else
        planner.plan_all();
    return draft.finished();
}

}  // namespace vesselbench
