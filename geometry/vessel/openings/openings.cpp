#include "geometry/vessel/openings/openings.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/end_arguments.h"
#include "geometry/vessel/openings/end_opener.h"
#include "geometry/vessel/openings/end_texts.h"
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
            if (!draft_.is_decided(e) && draft_.ends()[e].is_visible() && is_to_open(e))
                opener_.keep(e);
        }
        for (const std::size_t e : by_share()) {
            report_decided();
            if (!draft_.is_decided(e)) plan_end(e);
        }
        require_wanted();
    }

private:
    [[nodiscard]] bool is_to_open(std::size_t e) const {
        return !draft_.grazes(e) && (draft_.is_wanted(e) || draft_.verdict(e).open);
    }

    /// Rims and caps first, the largest share of the flow first: each cut limits the later ones.
    [[nodiscard]] std::vector<std::size_t> by_share() const {
        std::vector<std::size_t> order(draft_.ends().size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, std::greater{}, [&](std::size_t e) {
            return std::pair(draft_.ends()[e].is_visible(), draft_.verdict(e).profile.diameter);
        });
        return order;
    }

    /// \throw Cancelled if the user cancels
    void report_decided() const {
        progress_.report(draft_.decided_share(), "classifying the ends");
    }

    void plan_end(std::size_t e) {
        const SurfaceEnd& end = draft_.ends()[e];
        if (draft_.grazes(e))
            return draft_.close(e, "it lies in the side of a vessel that passes there");
        if (draft_.options().leave_closed && !end.is_visible() && !draft_.is_wanted(e)) {
            draft_.record(e).asked = true;
            return draft_.close(e, "closed ends are left as they are");
        }
        if (!is_to_open(e)) return draft_.close(e, closed_text(draft_.verdict(e)));
        if (opener_.cut(e)) return;
        if (draft_.options().strict)
            throw DiagnosedFailure(
                {.code = "end-cannot-be-cut",
                 .operation = "clip-opening",
                 .place = end.centre,
                 .words = {{"why", draft_.record(e).why}},
                 .remedies = {{.arguments = {{"closed", coordinates_argument(end.centre)}}}}});
        if (!draft_.is_fixed() && opener_.is_stub(e)) return draft_.remove_stub(e);
        draft_.record(e).tried = true;
        draft_.close(e, draft_.record(e).why);
    }

    /// \throw AlgorithmFailure if an end that was named is not open
    void require_wanted() {
        for (std::size_t e = 0; e < draft_.ends().size(); ++e)
            if (draft_.is_wanted(e) && !draft_.is_open(e)) refuse_wanted(e);
    }

    /// The trunk and an inlet cannot stay closed: a model that its blood does not enter is none.
    [[noreturn]] void refuse_wanted(std::size_t e) const {
        Diagnostic refusal{
            .code = "end-cannot-be-opened",
            .operation = "clip-opening",
            .place = draft_.ends()[e].centre,
            .words = {{"end", draft_.is_inlet(e) ? "inlet" : "end"}, {"why", why_not_open(e)}}};
        if (draft_.is_inlet(e) || draft_.verdict(e).share >= 1.0)
            refusal.words["advice"] =
                "the image, the segmentation or the surface has to end across the vessel there: "
                "crop it so, a little farther inward";
        else
            refusal.remedies = {{.arguments = with_closed(e)}};
        throw DiagnosedFailure(std::move(refusal));
    }

    /// What was named, but that the end stays closed.
    [[nodiscard]] std::map<std::string, std::string> with_closed(std::size_t e) const {
        Positions open = draft_.options().open, closed = draft_.options().closed;
        std::erase_if(open, [&](const Vec3& p) { return end_near(draft_.ends(), p) == e; });
        closed.push_back(draft_.ends()[e].centre);
        return end_arguments(draft_.options().inlets, open, closed);
    }

    /// An opening that was planned and could not be made says more than why there is no other.
    [[nodiscard]] std::string why_not_open(std::size_t e) const {
        const double same = 1e-6 * (1.0 + draft_.ends()[e].diameter);
        for (const FailedCut& failed : draft_.options().failed)
            if ((failed.tip - draft_.tip_place(e)).norm() < same) return text_of(failed.why);
        return draft_.record(e).why;
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
    if (!tip_near(graph, point, kFarthestTip))
        throw DiagnosedFailure({.code = "no-tip-near",
                                .operation = "clip-opening",
                                .place = found,
                                .words = {{"given", place_text(point)}}});
    return *tip;
}

LinesWithoutFrays planning_lines(const Surface& surface, const CenterlineGraph& graph,
                                 const OpeningPlanOptions& options) {
    return options.tip ? LinesWithoutFrays{graph, {}}
                       : without_frays(surface, graph, options.stubs);
}

Positions stubs_to_open(const Surface& surface, const CenterlineGraph& graph,
                        const OpeningPlanOptions& options, const Progress& progress) {
    const LinesWithoutFrays lines = planning_lines(surface, graph, options);
    PlanDraft draft(surface, lines, options, progress);
    Positions places;
    for (const EndRecord& stub : draft.stubs())
        if (stub.verdict->open && !stub.asked) places.push_back(stub.place);
    return places;
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
        throw DiagnosedFailure({.code = "no-end-to-open",
                                .operation = "clip-opening",
                                .remedies = {{.arguments = {{"tip", ""}}}}});
    if (options.tip)
        planner.plan_one(end_of_tip(draft.ends(), tip_to_open(lines.graph, *options.tip)));
    else
        planner.plan_all();
    return draft.finished();
}

}  // namespace vesselbench
