#include "geometry/vessel/ends/end_choice.h"

#include <algorithm>
#include <cmath>

namespace vesselbench {

namespace {

/// A flow needs so many openings.
constexpr std::size_t kFewestOpenings = 2;

void choose_inlet(EndChoice& choice, const std::vector<InletCandidate>& candidates) {
    for (const InletCandidate& candidate : candidates) choice.ends[candidate.end].inlet = candidate;
    if (!candidates.empty()) choice.inlet = candidates.front().end;
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

/// Who left two ends open or named them has cut the vessels there, and left closed what is closed:
/// it is opened only where somebody asks for it.
bool is_left_closed(const EndVerdict& verdict) {
    return !verdict.profile.is_cut() && verdict.profile.cuts_beside >= kFewestCuts;
}

void decide(EndVerdict& verdict) {
    const double odds = verdict.odds.for_opening();
    const bool counts = verdict.share > kLeastShare;
    if (is_left_closed(verdict)) {
        verdict.doubtful = counts && odds >= kCertain;
        return;
    }
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
        verdict->open = verdict->doubtful = true;
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
    std::vector<double> opening;
    for (const EndVerdict& verdict : choice.ends)
        opening.push_back(is_left_closed(verdict) ? 0.0 : verdict.odds.opening);
    choose_inlet(choice, inlet_candidates(scene, ends, profiles.ends, opening, progress));
    set_shares(choice);
    for (auto* list : {&choice.ends, &choice.stubs})
        for (EndVerdict& verdict : *list) decide(verdict);
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
        if (other->width > kWiderOutlet * best.width ||
            (furcates && other->odds * kInletCertain > best.odds))
            return true;
    }
    return false;
}

}  // namespace vesselbench
