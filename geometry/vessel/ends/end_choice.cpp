#include "geometry/vessel/ends/end_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/vessel/ends/flow_share.h"
#include "geometry/vessel/ends/weight_table.h"

namespace vesselbench {

namespace {

/// A flow needs so many openings.
constexpr std::size_t kFewestOpenings = 2;

void choose_inlet(EndChoice& choice, const std::vector<InletCandidate>& candidates) {
    for (const InletCandidate& candidate : candidates) choice.ends[candidate.end].inlet = candidate;
    if (!candidates.empty()) choice.inlet = candidates.front().end;
}

/// The diameter of the vessel whose flow is all of it [mm].
double reference_of(const EndChoice& choice) {
    if (choice.inlet) return choice.ends[*choice.inlet].profile.diameter;
    double widest = 0.0;
    for (const EndVerdict& verdict : choice.ends)
        widest = std::max(widest, verdict.profile.diameter);
    return widest;
}

void set_shares(EndChoice& choice) {
    const double reference = reference_of(choice);
    for (auto* list : {&choice.ends, &choice.stubs})
        for (EndVerdict& verdict : *list)
            verdict.share = share_of_flow(verdict.profile.diameter, reference);
}

void set_vessels(EndChoice& choice, const EndScene& scene, const std::vector<SurfaceEnd>& ends) {
    if (!choice.inlet || !ends[*choice.inlet].tip) return;
    const auto leading = vessels_from(scene.graph, *ends[*choice.inlet].tip);
    for (std::size_t e = 0; e < ends.size(); ++e)
        if (ends[e].tip && e != *choice.inlet) choice.ends[e].through = leading[*ends[e].tip];
}

/// Who left two ends open or named them has cut the vessels there, and left closed what is closed:
/// it is opened only where somebody asks for it.
bool is_left_closed(const EndVerdict& verdict) {
    return !verdict.profile.is_cut() && verdict.profile.cuts_beside >= kFewestCuts;
}

void decide(EndVerdict& verdict) {
    const double odds = verdict.odds.for_opening(), certain = end_limits().certain;
    const bool counts = verdict.share > kLeastShare;
    if (is_left_closed(verdict)) {
        verdict.doubtful = counts && odds >= certain;
        return;
    }
    verdict.open = odds >= (counts ? 1.0 : kLikely);
    verdict.doubtful = counts && odds < certain && odds > 1.0 / certain;
}

/// Closed ends behind a vessel with a share of the flow: it may end there, or one of them continues
/// it. If together they are likely enough to be openings, the likeliest is in doubt.
void continue_vessel(const std::vector<EndVerdict*>& behind, double share) {
    double none = 1.0;
    for (const EndVerdict* verdict : behind) {
        if (verdict->open || verdict->doubtful || is_left_closed(*verdict)) return;
        none *= 1.0 - verdict->odds.opening;
    }
    if (!((1.0 - none) * end_limits().certain > none)) return;
    EndVerdict* likeliest =
        *std::ranges::max_element(behind, {}, [](const EndVerdict* v) { return v->odds.opening; });
    likeliest->share = std::max(likeliest->share, share);
    likeliest->doubtful = true;
}

/// A wide vessel that splits into small tips, as a frayed end does, must not end unasked.
void continue_vessels(EndChoice& choice) {
    const double reference = reference_of(choice);
    std::map<std::size_t, std::vector<EndVerdict*>> behind;  // by branch
    std::map<std::size_t, double> diameters;
    for (EndVerdict& verdict : choice.ends)
        for (const SharedVessel& vessel : verdict.through) {
            behind[vessel.branch].push_back(&verdict);
            diameters[vessel.branch] = vessel.diameter;
        }
    std::vector<std::size_t> order;  // outermost first: an inner one leads to more ends
    for (const auto& [branch, ends] : behind) order.push_back(branch);
    std::ranges::stable_sort(order, {}, [&](std::size_t b) { return behind[b].size(); });
    for (const std::size_t branch : order)
        if (const double share = share_of_flow(diameters[branch], reference); share > kLeastShare)
            continue_vessel(behind[branch], share);
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
        verdict->open = verdict->doubtful = true;
        ++open;
    }
}

/// By its vessel, or by its rim or cap: a vessel may narrow towards its end, or be cut obliquely.
bool is_wider(const InletCandidate& other, const InletCandidate& best) {
    constexpr auto kClosure = static_cast<std::size_t>(
        std::ranges::find(kInletFeatures, std::string_view("closure")) - kInletFeatures.begin());
    const double limit = end_limits().wider_outlet;
    return other.width > limit * best.width ||
           std::exp(other.features[kClosure] - best.features[kClosure]) > limit;
}

}  // namespace

const EndLimits& end_limits() {
    static constexpr std::array<std::string_view, 3> kNames = {"certain", "inlet_certain",
                                                               "wider_outlet"};
    static const EndLimits limits = [] {
        const auto rows = weights_from<1>("end_limits.csv", kNames);
        return EndLimits{rows[0][0], rows[1][0], rows[2][0]};
    }();
    return limits;
}

EndChoice choose_ends(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                      const std::vector<Stub>& stubs, const Progress& progress) {
    EndChoice choice;
    const EndProfiles profiles = profiles_of(scene, ends, stubs, progress);
    for (const EndProfile& profile : profiles.ends)
        choice.ends.push_back({.profile = profile, .odds = odds_of(profile)});
    for (const EndProfile& profile : profiles.stubs)
        choice.stubs.push_back({.profile = profile, .odds = odds_of(profile)});
    std::vector<double> opening;
    for (const EndVerdict& verdict : choice.ends)
        opening.push_back(is_left_closed(verdict) ? 0.0 : verdict.odds.opening);
    choose_inlet(choice, inlet_candidates(scene, ends, profiles.ends, opening, progress));
    set_shares(choice);
    set_vessels(choice, scene, ends);
    for (auto* list : {&choice.ends, &choice.stubs})
        for (EndVerdict& verdict : *list) decide(verdict);
    continue_vessels(choice);
    open_enough(choice);
    return choice;
}

bool has_rival(const std::vector<EndVerdict>& ends, std::size_t inlet,
               const std::vector<bool>& opened) {
    const bool furcates = std::ranges::count(opened, true) > 2;
    const InletCandidate& best = *ends[inlet].inlet;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const auto& other = ends[e].inlet;
        if (e == inlet || !opened[e] || !other) continue;
        if (is_wider(*other, best) ||
            (furcates && other->odds * end_limits().inlet_certain > best.odds))
            return true;
    }
    return false;
}

}  // namespace vesselbench
