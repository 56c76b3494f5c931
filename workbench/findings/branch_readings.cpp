#include "workbench/findings/branch_readings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vesselbench {

namespace {

constexpr double kNecked = 1.1;     ///< a body is wider than its neck from here on [-]
constexpr double kWide = 0.8;       ///< as wide as the vessel it leaves [-]
constexpr double kShort = 1.0;      ///< hardly a branch: length over diameter [-]
constexpr double kLong = 1.5;       ///< rather a vessel [-]
constexpr double kTapers = 0.7;     ///< outer third over inner third [-]
constexpr double kEven = 0.85;      ///< the same of a vessel's [-]
constexpr double kOnwards = 0.7;    ///< cosine, 45 degrees off a vessel's direction
constexpr double kMissing = 0.1;    ///< EndProfile::need() that shows
constexpr double kFewVoxels = 4.0;  ///< across: less, and the image hardly shows it

using Evidence = std::vector<Diagnostic>;

void add(Evidence& evidence, bool holds, const char* code, const char* figure, double value) {
    if (holds) evidence.push_back({.code = code, .figures = {{figure, value}}});
}

double turn_deg(const EndProfile& profile) {
    return std::acos(std::clamp(profile.straight, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

double slenderness(const EndProfile& profile) {
    return profile.length / std::max(profile.diameter, 1e-9);
}

Evidence for_sac(const EndProfile& p) {
    Evidence evidence;
    add(evidence, p.neck > kNecked, "reading-necked", "ratio", p.neck);
    add(evidence, p.parent > 0.0 && p.diameter > kWide * p.parent, "reading-wide", "percent",
        100.0 * p.diameter / std::max(p.parent, 1e-9));
    if (p.need() < -kMissing) evidence.push_back({.code = "reading-flow-without"});
    return evidence;
}

Evidence for_vessel(const EndProfile& p) {
    Evidence evidence;
    add(evidence, slenderness(p) > kLong, "reading-long", "ratio", slenderness(p));
    add(evidence, p.neck <= kNecked && p.taper > kEven, "reading-even", "percent", 100.0 * p.taper);
    add(evidence, p.straight > kOnwards, "reading-onwards", "angle_deg", turn_deg(p));
    if (p.need() > kMissing) evidence.push_back({.code = "reading-flow-missing"});
    return evidence;
}

Evidence for_stub(const EndProfile& p) {
    Evidence evidence;
    add(evidence, slenderness(p) < kShort, "reading-short", "percent", 100.0 * slenderness(p));
    add(evidence, p.neck <= kNecked && p.taper < kTapers, "reading-tapers", "percent",
        100.0 * p.taper);
    add(evidence, p.across < kFewVoxels, "reading-thin", "across", p.across);
    return evidence;
}

}  // namespace

std::vector<Reading> branch_readings(const std::optional<EndVerdict>& verdict) {
    std::vector<Reading> readings = {{.key = "sac", .name = "sac (aneurysm?)", .anatomy = true},
                                     {.key = "vessel", .name = "vessel", .anatomy = true},
                                     {.key = "stub", .name = "stub"}};
    if (!verdict) return readings;
    const EndOdds& odds = verdict->odds;
    readings[0].odds = odds.sac;
    readings[1].odds = odds.opening;
    readings[2].odds = odds.bump;
    readings[0].evidence = for_sac(verdict->profile);
    readings[1].evidence = for_vessel(verdict->profile);
    readings[2].evidence = for_stub(verdict->profile);
    std::ranges::stable_sort(readings, std::greater{}, &Reading::odds);
    return readings;
}

}  // namespace vesselbench
