#include "geometry/vessel/openings/flow_check.h"

#include <algorithm>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/cut_trial.h"
#include "geometry/vessel/openings/surface_ends.h"
#include "geometry/vessel/openings/unlined_ends.h"

namespace vesselbench {

namespace {

/// What the openings lead into is a chamber if it is wider than them by this factor: a vessel at
/// its furcation is not, nor beside an aneurysm.
constexpr double kChamber = 2.0;

/// The ends one to a line; of very many, the widest.
std::string ends_text(const OpeningPlan& plan) {
    constexpr std::size_t kMostListed = 20;
    std::vector<EndRecord> ends = plan.ends;
    const std::size_t more = ends.size() > kMostListed ? ends.size() - kMostListed : 0;
    if (more > 0) {
        std::ranges::stable_sort(ends, std::greater<>(), &EndRecord::diameter);
        ends.resize(kMostListed);
    }
    std::string text;
    for (const EndRecord& end : ends)
        text += "\n  " + to_string(end.fate) + " at " + place_text(end.place) + ", diameter " +
                formatted(end.diameter) + " mm" + (end.why.empty() ? "" : ": " + end.why);
    if (more > 0) text += "\n  and " + std::to_string(more) + " more, which are no wider";
    return text;
}

/// Why a plan is none for a flow, and the ends that something has to be done about.
struct FlowProblem {
    std::string text;
    std::vector<EndRecord> ends;  ///< sacs last, the widest first
};

bool has_opening(const EndRecord& end) {
    return end.opening.has_value();
}

/// Ends without an opening that nobody wanted so.
std::vector<EndRecord> unwanted(const OpeningPlan& plan) {
    std::vector<EndRecord> ends;
    for (const EndRecord& end : plan.ends)
        if (!has_opening(end) && !end.asked) ends.push_back(end);
    std::ranges::stable_sort(
        ends, {}, [](const EndRecord& end) { return std::tuple(end.sac, -end.diameter); });
    return ends;
}

/// An end that went with the cut of another one is no wider than that cut.
double width_beside(const OpeningPlan& plan, const EndRecord& opened, EndFate fate) {
    const double cut = plan.openings[*opened.opening].place.diameter;
    return fate == EndFate::Removed ? std::max(opened.diameter, cut) : opened.diameter;
}

bool is_wider_than_all_openings(const OpeningPlan& plan, const EndRecord& end) {
    return std::ranges::none_of(plan.ends, [&](const EndRecord& other) {
        return has_opening(other) && end.diameter <= kAsLarge * width_beside(plan, other, end.fate);
    });
}

/// An open rim that would vanish: the surface ends there, and blood flowed through it.
bool is_large_rim(const OpeningPlan& plan, const EndRecord& end) {
    return end.rim && !end.shared && end.diameter >= kLargeEnd * widest_opening(plan);
}

/// The rest of a chamber, such as a heart's: a wide mouth may have been closed there, but it may be
/// a giant aneurysm as well.
bool is_end_of_chamber(const OpeningPlan& plan, const EndRecord& end) {
    return end.rest_of > 0.0 && std::ranges::all_of(plan.openings, [&](const PlannedOpening& o) {
               return end.rest_of >= kChamber * o.place.diameter;
           });
}

bool is_excused(const OpeningPlan& plan, const EndRecord& end) {
    return (end.sac || end.unlined) && !is_end_of_chamber(plan, end);
}

/// Empty text: there is none.
FlowProblem flow_problem(const OpeningPlan& plan) {
    FlowProblem problem{.text = "", .ends = unwanted(plan)};
    if (plan.openings.size() < 2) {
        problem.text = "a flow needs two openings, and there " +
                       std::string(plan.openings.empty() ? "is none" : "is one only");
        return problem;
    }
    std::erase_if(problem.ends, [&](const EndRecord& end) {
        return !is_large_rim(plan, end) &&
               (is_excused(plan, end) || !is_wider_than_all_openings(plan, end));
    });
    if (problem.ends.empty()) return problem;
    const EndRecord& end = problem.ends.front();
    const bool largest = is_wider_than_all_openings(plan, end);
    problem.text = std::string(largest ? "the largest end" : "a wide open rim") + ", at " +
                   place_text(end.place) + " with a diameter of " + formatted(end.diameter) +
                   " mm, is " + to_string(end.fate) + " (" + end.why + "): blood would " +
                   (largest ? "enter" : "leave") + " elsewhere";
    if (is_end_of_chamber(plan, end))
        problem.text += "; the vessels lead into a space " + formatted(end.rest_of) +
                        " mm wide, whose mouth may be closed";
    return problem;
}

std::string points_text(const Positions& points) {
    std::vector<std::string> texts;
    for (const Vec3& point : points) texts.push_back(coordinates_argument(point));
    return joined(texts, ",");
}

/// An argument for clip-opening, typed alone or in a recipe.
std::string advice(const std::string& argument, const std::string& effect) {
    return "\nclip-opening " + argument + " " + effect +
           " (with prepare: --resume --set clip-opening." + argument + ")";
}

/// Looks for arguments that solve a problem, by planning with them.
class WayOn {
public:
    WayOn(const Surface& surface, const CenterlineGraph& graph, const OpeningPlanOptions& options,
          const FlowProblem& problem, Progress cancel)
        : surface_(surface),
          graph_(graph),
          options_(options),
          problem_(problem),
          cancel_(std::move(cancel)) {}

    [[nodiscard]] std::string text(std::size_t openings) const {
        std::string text = by_opening();
        if (text.empty() && (openings == 1 || problem_.ends.size() == 1)) text = by_hand();
        if (text.empty() && openings >= 2) text = by_closing();
        if (text.empty())
            text =
                "\nnone of these ends can be opened: clip-opening check=none makes a model that is "
                "not for flow (with prepare: --for rp)";
        return text;
    }

private:
    enum class Judgement { Impossible, Insufficient, Good };

    [[nodiscard]] Judgement judgement(const OpeningPlanOptions& options) const {
        try {
            if (!options.stubs.empty() && options.open.size() > options_.open.size())
                return judgement_with_lines(options);
            const OpeningPlan plan = plan_openings(surface_, graph_, options, cancel_);
            return flow_problem(plan).text.empty() ? Judgement::Good : Judgement::Insufficient;
        } catch (const AlgorithmFailure&) {
            return Judgement::Impossible;
        }
    }

    /// The same where the ends to be opened may need lines of their own.
    [[nodiscard]] Judgement judgement_with_lines(OpeningPlanOptions options) const {
        Positions wanted = options.open;
        wanted.insert(wanted.end(), options.inlets.begin(), options.inlets.end());
        LinesAndStubs lines = lines_to_ends(surface_, wanted, cancel_);
        options.stubs = std::move(lines.stubs);
        const OpeningPlan plan = plan_openings(surface_, *lines.graph, options, cancel_);
        return flow_problem(plan).text.empty() ? Judgement::Good : Judgement::Insufficient;
    }

    /// Opens one end after the other until it is enough.
    [[nodiscard]] std::string by_opening() const {
        OpeningPlanOptions options = options_;
        int tries = 0;
        for (const EndRecord& end : problem_.ends) {
            if (end.tried) continue;
            if (++tries > kMostTries) break;
            options.open.push_back(end.place);
            const Judgement found = judgement(options);
            if (found == Judgement::Good)
                return advice("open=" + points_text(options.open),
                              options.open.size() == 1 ? "opens it" : "opens them");
            if (found == Judgement::Impossible) options.open.pop_back();
        }
        return "";
    }

    /// A cut farther from the tip than the plan may make one.
    [[nodiscard]] std::string by_hand() const {
        const std::vector<SurfaceEnd> ends = find_surface_ends(surface_, graph_);
        CutTrials trials(surface_, graph_, ends);
        for (const EndRecord& end : problem_.ends) {
            cancel_.check_cancelled();
            const auto e = end_near(ends, end.place);
            if (end.sac || end.unlined || !e || !ends[*e].tip) continue;
            const auto place =
                nearest_opening_place(surface_, graph_, *ends[*e].tip, [&](const OpeningPlace& at) {
                    cancel_.check_cancelled();
                    return !has_failed(at) && trials.problem_of(at, *e).empty();
                });
            if (!place) continue;
            return "\nvesselbench apply project.vbench clip-opening tip=" +
                   coordinates_argument(place->tip) + " distance=" + formatted(place->distance) +
                   " cuts it there (then, with prepare: --resume)";
        }
        return "";
    }

    [[nodiscard]] bool has_failed(const OpeningPlace& place) const {
        return std::ranges::any_of(options_.failed, [&](const FailedCut& failed) {
            return (failed.place - place.plane.point).norm() < 0.01 * place.diameter;
        });
    }

    [[nodiscard]] std::string by_closing() const {
        OpeningPlanOptions options = options_;
        for (const EndRecord& end : problem_.ends) options.closed.push_back(end.place);
        return judgement(options) == Judgement::Good ? closing_advice(options.closed) : "";
    }

    /// A large tree takes seconds to plan.
    static constexpr int kMostTries = 10;

    const Surface& surface_;
    const CenterlineGraph& graph_;
    const OpeningPlanOptions& options_;
    const FlowProblem& problem_;
    Progress cancel_;
};

}  // namespace

double widest_opening(const OpeningPlan& plan) {
    double widest = 0.0;
    for (const EndRecord& end : plan.ends)
        if (end.opening) widest = std::max(widest, end.diameter);
    return widest;
}

std::string why_no_flow(const OpeningPlan& plan) {
    const std::string text = flow_problem(plan).text;
    return text.empty() ? "" : text + ". The ends found:" + ends_text(plan);
}

void check_flow(const OpeningPlan& plan, const Surface& surface, const CenterlineGraph& graph,
                const OpeningPlanOptions& options, const Progress& progress) {
    const FlowProblem problem = flow_problem(plan);
    if (problem.text.empty()) return;
    progress.report(0.0, "looking for a way on");
    const WayOn way_on(surface, graph, options, problem, progress.silent());
    throw AlgorithmFailure(why_no_flow(plan) + way_on.text(plan.openings.size()));
}

std::string closing_advice(const Positions& closed) {
    return advice("closed=" + points_text(closed), closed.size() == 1
                                                       ? "leaves it closed on purpose"
                                                       : "leaves them closed on purpose");
}

}  // namespace vesselbench
