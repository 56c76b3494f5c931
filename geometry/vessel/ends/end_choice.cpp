#include "geometry/vessel/ends/end_choice.h"

#include <algorithm>
#include <cmath>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/flow_tree.h"

namespace vesselbench {

namespace {

/// A flow needs so many openings.
constexpr std::size_t kFewestOpenings = 2;
/// A root that is narrower than the other by this factor is not about as plausible, whatever the
/// tree says: the inlet's end has to carry the flow [-].
constexpr double kNarrowInlet = 0.5;
/// The inlet carries all of the flow: besides its furcations, the cube of its diameter counts.
constexpr double kFlowPower = 3.0;

/// The lines' diameters where blood flows: branches that end in a sac or a bump have none.
std::vector<double> flowing(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                            const std::vector<EndVerdict>& verdicts) {
    std::vector<double> diameters = course_diameters(scene.graph);
    for (std::size_t e = 0; e < ends.size(); ++e)
        if (ends[e].tip && verdicts[e].odds.for_opening() < 1.0)
            diameters[branch_of_tip(scene.graph, *ends[e].tip)] = 0.0;
    return diameters;
}

struct Root {
    std::size_t end = 0;
    double cost = 0.0;
};

/// The ends where the blood may enter, likeliest first.
std::vector<Root> roots_of(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                           const std::vector<EndVerdict>& verdicts, const Progress& progress) {
    const std::vector<double> diameters = flowing(scene, ends, verdicts);
    // A trunk may end in a spike, or its course lead through a bend that is narrower than its end.
    // Both ends of a vessel without furcations have its course in common.
    const auto width = [&](std::size_t e) {
        const EndProfile& profile = verdicts[e].profile;
        return profile.parent > 0.0 ? std::max(profile.diameter, ends[e].diameter)
                                    : ends[e].diameter;
    };
    double widest = 0.0;
    for (std::size_t e = 0; e < ends.size(); ++e)
        if (verdicts[e].odds.for_opening() >= 1.0) widest = std::max(widest, width(e));
    std::vector<Root> roots;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        progress.check_cancelled();
        if (verdicts[e].odds.for_opening() < 1.0) continue;
        const double d = width(e);
        if (d < kNarrowInlet * widest) continue;
        const double cost = ends[e].tip ? root_cost(scene.graph, diameters, *ends[e].tip) : 0.0;
        roots.push_back({e, cost + kFlowPower * std::log(widest / d)});
    }
    std::ranges::stable_sort(roots, {}, &Root::cost);
    return roots;
}

void set_shares(EndChoice& choice) {
    double reference = 0.0;
    if (choice.inlet)
        reference = choice.ends[*choice.inlet].profile.diameter;
    else
        for (const EndVerdict& verdict : choice.ends)
            reference = std::max(reference, verdict.profile.diameter);
    for (auto* list : {&choice.ends, &choice.stubs})
        for (EndVerdict& verdict : *list)
            verdict.share = reference > 0.0
                                ? std::min(1.0, std::pow(verdict.profile.diameter / reference, 3.0))
                                : 0.0;
}

void decide(EndVerdict& verdict) {
    const double odds = verdict.odds.for_opening();
    const bool counts = verdict.share > kLeastShare;
    verdict.open = odds >= (counts ? 1.0 : kLikely);
    verdict.doubtful = counts && odds < kCertain && odds > 1.0 / kCertain;
}

/// Opens the likeliest of the others if there are too few.
void open_enough(EndChoice& choice) {
    std::vector<EndVerdict*> all;
    for (auto* list : {&choice.ends, &choice.stubs})
        for (EndVerdict& verdict : *list) all.push_back(&verdict);
    std::ranges::stable_sort(all, std::greater{},
                             [](const EndVerdict* v) { return v->odds.for_opening(); });
    auto open = static_cast<std::size_t>(
        std::ranges::count_if(all, [](const EndVerdict* v) { return v->open; }));
    for (EndVerdict* verdict : all) {
        if (open >= kFewestOpenings) return;
        if (verdict->open) continue;
        verdict->open = true;
        ++open;
    }
}

}  // namespace

EndChoice choose_ends(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                      const std::vector<Stub>& stubs, const Progress& progress) {
    EndChoice choice;
    const EndProfiles profiles = profiles_of(scene, ends, stubs, progress);
    for (const EndProfile& profile : profiles.ends)
        choice.ends.push_back({.profile = profile, .odds = odds_of(profile)});
    for (const EndProfile& profile : profiles.stubs)
        choice.stubs.push_back({.profile = profile, .odds = odds_of(profile)});
    const std::vector<Root> roots = roots_of(scene, ends, choice.ends, progress);
    if (!roots.empty()) {
        choice.inlet = roots.front().end;
        for (std::size_t r = 1; r < roots.size(); ++r)
            if (roots[r].cost < roots.front().cost + std::log(kCertain))
                choice.other_inlets.push_back(roots[r].end);
    }
    set_shares(choice);
    for (auto* list : {&choice.ends, &choice.stubs})
        for (EndVerdict& verdict : *list) decide(verdict);
    open_enough(choice);
    return choice;
}

}  // namespace vesselbench
