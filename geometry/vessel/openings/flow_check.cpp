#include "geometry/vessel/openings/flow_check.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/ends/flow_share.h"
#include "geometry/vessel/ends/stub_lines.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/cut_trial.h"
#include "geometry/vessel/openings/end_arguments.h"

namespace vesselbench {

namespace {

/// An end beside a cut at least this wide [-], within this many of its diameters, is a part of it.
constexpr double kPartWidth = 0.9;
constexpr double kPartReach = 2.0;

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
        text += "\n  " + (end.number > 0 ? std::to_string(end.number) + " " : std::string()) +
                to_string(end.fate) + " at " + place_text(end.place) + ", diameter " +
                formatted(end.diameter) + " mm" + (end.why.empty() ? "" : ": " + end.why);
    if (more > 0) text += "\n  and " + std::to_string(more) + " more, which are no wider";
    return text;
}

/// Why a plan is none for a flow, and the ends that something has to be done about.
struct FlowProblem {
    std::string code;  ///< of the diagnostics; empty: there is no problem
    std::map<std::string, std::string> words;
    std::vector<EndRecord> ends;   ///< the largest share first
    bool doubts = false;           ///< nothing is wrong if the likelier choice is right
    std::vector<int> inlets = {};  ///< numbers of the inlets where they are in doubt
};

bool has_opening(const EndRecord& end) {
    return end.opening.has_value();
}

/// It is certain that no blood flows there.
bool is_certainly_closed(const EndRecord& end) {
    return end.verdict && end.verdict->odds.for_opening() < 1.0 / end_limits().certain;
}

/// It was to be opened, or may be an opening. Of what was left closed beside cuts, the odds do not
/// say so.
bool may_be_opening(const EndRecord& end) {
    return end.verdict && (end.verdict->open || end.verdict->doubtful);
}

/// An end that went with the cut of another one as wide, or cannot be cut beside it, is a part of
/// it.
bool is_part_of_cut(const OpeningPlan& plan, const EndRecord& end) {
    return (end.shared || end.tried) &&
           std::ranges::any_of(plan.openings, [&](const PlannedOpening& opening) {
               return (opening.place.plane.point - end.place).norm() <
                          kPartReach * opening.place.diameter &&
                      opening.place.diameter >= kPartWidth * end.diameter;
           });
}

/// An end whose flow would be missing, though nobody asked for it.
bool is_missing(const OpeningPlan& plan, const EndRecord& end) {
    return !has_opening(end) && !end.asked && end.share() > kLeastShare && may_be_opening(end) &&
           !is_part_of_cut(plan, end);
}

bool is_inlet(const OpeningPlan& plan, const EndRecord& end) {
    return end.opening && std::ranges::count(plan.inlets, *end.opening) > 0;
}

/// The end of the trunk, which is the inlet, or the outlet where blood gathers, and the likeliest
/// of the others; null: there is none.
std::pair<const EndRecord*, const EndRecord*> trunk_and_rival(const OpeningPlan& plan) {
    const EndRecord *trunk = nullptr, *rival = nullptr;
    for (const EndRecord& end : plan.ends) {
        if (!end.verdict || !end.verdict->inlet || !end.opening) continue;
        if (is_inlet(plan, end) != plan.gathers)
            trunk = &end;
        else if (!rival || end.verdict->inlet->odds > rival->verdict->inlet->odds)
            rival = &end;
    }
    return {trunk, rival};
}

/// An end that could not be cut, behind a vessel with a share of the flow that leads to no opening:
/// each of its tips may be thin, where a wide end is frayed.
bool ends_vessel(const OpeningPlan& plan, const EndRecord& end) {
    const EndRecord* trunk = trunk_and_rival(plan).first;
    if (!end.tried || !end.verdict || !end.verdict->open || !trunk) return false;
    const auto leads_to_opening = [&](std::size_t branch) {
        return std::ranges::any_of(plan.ends, [&](const EndRecord& other) {
            return other.verdict && (has_opening(other) || is_part_of_cut(plan, other)) &&
                   std::ranges::count(other.verdict->through, branch, &SharedVessel::branch) > 0;
        });
    };
    return std::ranges::any_of(end.verdict->through, [&](const SharedVessel& vessel) {
        const double whole = trunk->verdict->profile.diameter;
        return share_of_flow(vessel.diameter, whole) > kLeastShare &&
               !leads_to_opening(vessel.branch);
    });
}

bool is_doubtful(const OpeningPlan& plan, const EndRecord& end) {
    return end.verdict && end.verdict->doubtful && !end.asked && !end.wanted &&
           !is_part_of_cut(plan, end);
}

std::string numbered(const EndRecord& end) {
    return "end " + std::to_string(end.number) + " at " + place_text(end.place) + ", " +
           formatted(end.diameter) + " mm wide with " +
           formatted(100.0 * end.share(), "%.3g %% of the flow");
}

std::vector<int> inlet_numbers(const OpeningPlan& plan) {
    std::vector<int> numbers;
    for (const EndRecord& end : plan.ends)
        if (end.number > 0 && is_inlet(plan, end)) numbers.push_back(end.number);
    std::ranges::sort(numbers);
    return numbers;
}

std::string trunk_doubt_text(const EndRecord& trunk, const EndRecord& rival, bool gathers) {
    const auto likely = [](const EndRecord& end) {
        return formatted(100.0 * end.verdict->inlet->odds, "%.0f %% likely");
    };
    return std::string("the blood ") + (gathers ? "leaves" : "enters") + " at end " +
           std::to_string(trunk.number) + " at " + place_text(trunk.place) + " (" + likely(trunk) +
           "), rather than at end " + std::to_string(rival.number) + " at " +
           place_text(rival.place) + " (" + likely(rival) + ")";
}

std::string doubt_text(const EndRecord& end) {
    return numbered(end) + ", is " + (has_opening(end) ? "an opening" : "none") + " (" +
           formatted(100.0 * end.verdict->odds.opening, "%.0f %% likely)");
}

FlowProblem flow_problem(const OpeningPlan& plan, bool accept_doubts) {
    FlowProblem problem;
    const auto collect = [&](const auto& test) {
        for (const EndRecord& end : plan.ends)
            if (test(end)) problem.ends.push_back(end);
        std::ranges::stable_sort(problem.ends, std::greater{},
                                 [](const EndRecord& end) { return end.share(); });
    };
    if (plan.openings.size() < 2) {
        collect([](const EndRecord& end) { return !has_opening(end) && !end.asked; });
        problem.code = "too-few-openings";
        problem.words["found"] = plan.openings.empty() ? "none" : "only one";
        return problem;
    }
    collect([&](const EndRecord& end) {
        return ends_vessel(plan, end) ||
               (is_missing(plan, end) && !(is_doubtful(plan, end) && !end.tried));
    });
    if (!problem.ends.empty()) {
        const EndRecord& end = problem.ends.front();
        problem.code = "flow-missing";
        problem.words = {{"end", numbered(end)}, {"fate", to_string(end.fate)}, {"why", end.why}};
        return problem;
    }
    if (accept_doubts) return problem;
    collect([&](const EndRecord& end) { return is_doubtful(plan, end); });
    std::vector<std::string> doubts;
    for (const EndRecord& end : problem.ends) doubts.push_back(doubt_text(end));
    if (const auto [trunk, rival] = trunk_and_rival(plan); plan.inlet_doubtful && trunk && rival) {
        problem.inlets = inlet_numbers(plan);
        doubts.push_back(trunk_doubt_text(*trunk, *rival, plan.gathers));
        if (problem.ends.empty()) problem.ends = {*trunk};
    }
    if (doubts.empty()) return problem;
    problem.doubts = true;
    problem.code = "end-in-doubt";
    problem.words["doubts"] = joined(doubts, ", and that ");
    return problem;
}

std::map<std::string, std::string> named_in(const OpeningPlanOptions& options) {
    return end_arguments(options.inlets, options.open, options.closed);
}

/// A remedy and what it does.
struct Advice {
    std::map<std::string, std::string> arguments;  ///< of clip-opening; empty: there is none
    std::string effect;
    bool before = false;  ///< an edit of its own

    [[nodiscard]] std::vector<Remedy> remedies() const {
        if (arguments.empty()) return {};
        return {{.operation = "clip-opening", .arguments = arguments, .before = before}};
    }
};

/// The likelier choice as answers to all doubts at once, by the ends' numbers, so that a wrong one
/// can be changed.
Advice answers_by_number(const FlowProblem& problem) {
    std::vector<std::string> open, closed;
    for (const EndRecord& end : problem.ends)
        if (end.verdict->doubtful)
            (has_opening(end) ? open : closed).push_back(std::to_string(end.number));
    Advice advice{.arguments = {},
                  .effect =
                      "answers as is likelier: change the numbers that are "
                      "wrong"};
    std::vector<std::string> inlets;
    for (const int number : problem.inlets) inlets.push_back(std::to_string(number));
    if (!inlets.empty()) advice.arguments["inlet_ends"] = joined(inlets, ",");
    if (!open.empty()) advice.arguments["open_ends"] = joined(open, ",");
    if (!closed.empty()) advice.arguments["close_ends"] = joined(closed, ",");
    return advice;
}

/// The same by places, with those of the ends that were named already: numbers are those of a plan
/// without names.
Advice answers_by_place(const OpeningPlan& plan, const FlowProblem& problem,
                        const OpeningPlanOptions& options) {
    OpeningPlanOptions answered = options;
    for (const EndRecord& end : problem.ends)
        if (end.verdict->doubtful)
            (has_opening(end) ? answered.open : answered.closed).push_back(end.place);
    if (!problem.inlets.empty())
        for (const EndRecord& end : plan.ends)
            if (is_inlet(plan, end)) answered.inlets.push_back(end.place);
    return {.arguments = named_in(answered),
            .effect =
                "answers as is likelier, and as before: a place that is wrong belongs to the "
                "other list, open or closed"};
}

Advice answers(const OpeningPlan& plan, const FlowProblem& problem,
               const OpeningPlanOptions& options) {
    const bool named = !options.inlets.empty() || !options.open.empty() || !options.closed.empty();
    return named ? answers_by_place(plan, problem, options) : answers_by_number(problem);
}

/// \param options with the closed ends
Advice closing(const OpeningPlanOptions& options) {
    return {named_in(options), options.closed.size() == 1 ? "leaves it closed on purpose"
                                                          : "leaves them closed on purpose"};
}

/// One for each end; the first one has the text about all of them.
std::vector<Diagnostic> diagnostics_of(const OpeningPlan& plan, const FlowProblem& problem,
                                       const std::vector<Advice>& ways) {
    Diagnostic whole{.code = problem.code, .operation = "clip-opening", .words = problem.words};
    for (const Advice& way : ways)
        for (Remedy& remedy : way.remedies()) whole.remedies.push_back(std::move(remedy));
    std::vector<Diagnostic> diagnostics;
    for (const EndRecord& end : problem.ends) {
        Diagnostic& one = diagnostics.emplace_back(whole);
        one.place = end.place;
        one.figures = {{"number", end.number},
                       {"diameter_mm", end.diameter},
                       {"flow_share", end.share()},
                       {"opening", end.verdict ? end.verdict->odds.opening : 0.0}};
        if (problem.doubts && end.verdict->doubtful) one.words["doubts"] = doubt_text(end);
    }
    if (diagnostics.empty()) diagnostics.push_back(whole);
    diagnostics[0].words = problem.words;
    diagnostics[0].words["ends"] = ends_text(plan);
    if (whole.remedies.empty())
        diagnostics[0].words["no_way"] = "none of these ends can be opened";
    else
        diagnostics[0].words["advice"] = ways.front().effect;
    if (ways.size() > 1) diagnostics[0].words["else"] = ways.back().effect;
    return diagnostics;
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

    [[nodiscard]] Advice advice(std::size_t openings) const {
        Advice found = by_opening();
        if (found.arguments.empty() && (openings == 1 || problem_.ends.size() == 1))
            found = by_hand();
        if (found.arguments.empty() && openings >= 2) found = by_closing();
        return found;
    }

private:
    enum class Judgement { Impossible, Insufficient, Good };

    [[nodiscard]] Judgement judgement(const OpeningPlanOptions& options) const {
        try {
            if (!options.stubs.empty() && options.open.size() > options_.open.size())
                return judgement_with_lines(options);
            const OpeningPlan plan = plan_openings(surface_, graph_, options, cancel_);
            return flow_problem(plan, true).code.empty() ? Judgement::Good
                                                         : Judgement::Insufficient;
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
        return flow_problem(plan, true).code.empty() ? Judgement::Good : Judgement::Insufficient;
    }

    /// Opens one end after the other until it is enough.
    [[nodiscard]] Advice by_opening() const {
        OpeningPlanOptions options = options_;
        int tries = 0;
        for (const EndRecord& end : problem_.ends) {
            if (end.tried || is_certainly_closed(end)) continue;
            if (++tries > kMostTries) break;
            options.open.push_back(end.place);
            const Judgement found = judgement(options);
            if (found == Judgement::Good)
                return {named_in(options), options.open.size() == 1 ? "opens it" : "opens them"};
            if (found == Judgement::Impossible) options.open.pop_back();
        }
        return {};
    }

    /// A cut farther from the tip than the plan may make one.
    [[nodiscard]] Advice by_hand() const {
        const std::vector<SurfaceEnd> ends = find_surface_ends(surface_, graph_);
        CutTrials trials(surface_, graph_, ends, std::vector<double>(ends.size(), 0.0));
        for (const EndRecord& end : problem_.ends) {
            cancel_.check_cancelled();
            const auto e = end_near(ends, end.place);
            if (is_certainly_closed(end) || end.stub || !e || !ends[*e].tip) continue;
            const auto place =
                nearest_opening_place(surface_, graph_, *ends[*e].tip, [&](const OpeningPlace& at) {
                    cancel_.check_cancelled();
                    return !has_failed(at) && trials.problem_of(at, *e).empty();
                });
            if (!place) continue;
            return {{{"tip", coordinates_argument(place->tip)},
                     {"distance", formatted(place->distance)}},
                    "cuts it there",
                    true};
        }
        return {};
    }

    [[nodiscard]] bool has_failed(const OpeningPlace& place) const {
        return std::ranges::any_of(options_.failed, [&](const FailedCut& failed) {
            return (failed.place - place.plane.point).norm() < 0.01 * place.diameter;
        });
    }

    /// Never of the trunk: a model that its blood does not enter is none for a flow.
    [[nodiscard]] Advice by_closing() const {
        if (std::ranges::any_of(problem_.ends, [](const EndRecord& e) { return e.share() >= 1.0; }))
            return {};
        OpeningPlanOptions options = options_;
        for (const EndRecord& end : problem_.ends) options.closed.push_back(end.place);
        return judgement(options) == Judgement::Good ? closing(options) : Advice{};
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

std::string why_no_flow(const OpeningPlan& plan, bool accept_doubts) {
    const FlowProblem problem = flow_problem(plan, accept_doubts);
    if (problem.code.empty()) return "";
    return text_of({.code = problem.code, .words = problem.words}) +
           ". The ends found:" + ends_text(plan);
}

void check_flow(const OpeningPlan& plan, const Surface& surface, const CenterlineGraph& graph,
                const OpeningPlanOptions& options, const Progress& progress) {
    const FlowProblem problem = flow_problem(plan, options.accept_doubts);
    if (problem.code.empty()) return;
    std::vector<Advice> ways;
    if (problem.doubts) {
        ways = {answers(plan, problem, options),
                {{{"accept_doubts", "true"}}, "continues with the likelier choice"}};
        std::erase_if(ways, [](const Advice& advice) { return advice.arguments.empty(); });
    } else {
        progress.report(0.0, "finding a remedy");
        ways = {WayOn(surface, graph, options, problem, progress.silent())
                    .advice(plan.openings.size())};
    }
    throw DiagnosedFailure(diagnostics_of(plan, problem, ways));
}

Remedy closing_remedy(const OpeningPlanOptions& options) {
    return closing(options).remedies().front();
}

}  // namespace vesselbench
