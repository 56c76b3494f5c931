#include "meshing/stamp/separate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "meshing/remeshing/local_remesh.h"
#include "meshing/stamp/contact.h"
#include "meshing/stamp/contact_arms.h"
#include "meshing/stamp/contact_bridge.h"
#include "meshing/stamp/refusal.h"
#include "meshing/stamp/twin_tubes.h"
#include "meshing/stamp/twin_walls.h"

namespace vesselbench {

namespace {

constexpr double kClear = 0.65;     ///< the best pairing's misfit, of the next one's, at most [-]
constexpr double kOverlap = 0.5;    ///< tubes that enter each other more are one vessel [radii]
constexpr double kBeyond = 1.0;     ///< zone around the contact, beyond it [radii]
constexpr double kFarBeyond = 3.0;  ///< the same, if that is not enough [radii]
constexpr double kLargest = 0.35;   ///< misfit of a pairing that is none [-]

[[noreturn]] void refuse_joined(const ContactZone& zone) {
    refuse("contact-joins", "separate", zone.centre, {}, {{.arguments = {{"at", ""}}}});
}

std::size_t nearest_arm(const ContactZone& zone, const Vec3& to) {
    const auto nearest = std::ranges::min_element(
        zone.arms, {}, [&](const ContactArm& arm) { return (arm.centre - to).norm(); });
    return static_cast<std::size_t>(nearest - zone.arms.begin());
}

TwinTubes named_twins(const ContactZone& zone, const std::array<Vec3, 2>& vessel) {
    const std::size_t from = nearest_arm(zone, vessel[0]), to = nearest_arm(zone, vessel[1]);
    if (from == to)
        refuse("contact-one-arm", "separate", vessel[0], {},
               {{.arguments = {{"side_a", ""}}}, {.arguments = {{"side_b", ""}}}});
    // Pairs of arms are named by the first arm's partner.
    const std::size_t partner = from == 0 || to == 0 ? from + to : 6 - from - to;
    TwinTubes twins = twin_tubes(zone, partner);
    if (twins.overlap >= kOverlap) refuse_joined(zone);
    return twins;
}

TwinTubes decided_twins(const ContactZone& zone, const Progress& progress) {
    std::vector<TwinTubes> possible;
    for (const std::size_t partner : {1, 2, 3}) {
        progress.check_cancelled();
        TwinTubes twins = twin_tubes(zone, partner);
        if (twins.overlap < kOverlap && std::isfinite(twins.misfit))
            possible.push_back(std::move(twins));
    }
    std::ranges::sort(possible, {}, &TwinTubes::misfit);
    if (possible.empty() || possible[0].misfit > kLargest) refuse_joined(zone);
    if (possible.size() > 1 && possible[0].misfit > kClear * possible[1].misfit)
        refuse("contact-pairing-unclear", "separate", zone.centre,
               {{"misfit_percent", 100.0 * possible[0].misfit},
                {"other_percent", 100.0 * possible[1].misfit}},
               {{.arguments = {{"side_a", ""}}}, {.arguments = {{"side_b", ""}}}});
    return std::move(possible[0]);
}

/// A contact's zone and vessels, and the bridge between them.
struct Found {
    ContactZone zone;
    TwinTubes twins;
    ContactBridge bridge;
};

Found found_at(const Surface& surface, const SurfaceDistance& places, const Vec3& at,
               const SeparateParameters& parameters, double beyond, const Progress& progress) {
    Found found{.zone = contact_zone(surface, places, at, beyond, progress)};
    found.twins = parameters.vessel ? named_twins(found.zone, *parameters.vessel)
                                    : decided_twins(found.zone, progress);
    found.bridge = contact_bridge(found.zone, found.twins);
    return found;
}

/// The contact around a place, with the ball around the middle of its bridge if there are four
/// arms, too.
Found found_near(const Surface& surface, const SurfaceDistance& places,
                 const SeparateParameters& parameters, double beyond, const Progress& progress) {
    if (!parameters.at.allFinite()) throw InvalidInput("the place of a contact must be finite");
    const auto waist = contact_at(surface, places, parameters.at);
    const Vec3 at = waist ? waist->centre : parameters.at;
    Found found = found_at(surface, places, at, parameters, beyond, progress.part(0.0, 0.4));
    if ((found.bridge.centre - at).norm() < 0.2 * found.zone.reach) return found;
    try {
        return found_at(surface, places, found.bridge.centre, parameters, beyond,
                        progress.part(0.4, 0.5));
    } catch (const DiagnosedFailure&) {
        return found;  // the place that was given serves, its bridge's middle does not
    }
}

struct Parted {
    Found found;
    TwinWalls walls;
};

Parted parted_within(const Surface& surface, const SurfaceDistance& places,
                     const SeparateParameters& parameters, double beyond,
                     const Progress& progress) {
    require_positive("gap", parameters.gap);
    require_in_proportion("gap", parameters.gap, surface, 0.5);
    progress.report(0.0, "looking for the vessels");
    Parted parted{.found =
                      found_near(surface, places, parameters, beyond, progress.part(0.0, 0.6))};
    progress.report(0.6, "closing the walls");
    parted.walls = twin_walls(parted.found.zone, parted.found.twins, parted.found.bridge,
                              parameters.gap, progress.part(0.6, 1.0));
    return parted;
}

/// Vessels that leave each other slowly need a wider zone.
Parted parted_at(const Surface& surface, const SurfaceDistance& places,
                 const SeparateParameters& parameters, const Progress& progress) {
    try {
        return parted_within(surface, places, parameters, kBeyond, progress.part(0.0, 0.5));
    } catch (const DiagnosedFailure& failure) {
        try {
            return parted_within(surface, places, parameters, kFarBeyond, progress.part(0.5, 1.0));
        } catch (const DiagnosedFailure&) {
            throw failure;  // the zone was not the reason
        }
    }
}

std::array<Vec3, 2> first_vessel(const Found& found) {
    return {found.zone.arms[found.twins.arms[0][0]].centre,
            found.zone.arms[found.twins.arms[0][1]].centre};
}

/// Where the wall that goes lies highest over both vessels: what branches off there, a sac or a
/// branch that ends in the zone, goes with it.
void measure_lost(const Found& found, const TwinWalls& walls, SeparateReport& report) {
    const Surface& part = found.zone.part.surface;
    std::vector<std::uint8_t> kept(part.vertex_count(), 0);
    for (const VertexId v : walls.part.former)
        if (v != kNewVertex) kept[v] = 1;
    for (VertexId v = 0; v < kept.size(); ++v) {
        if (kept[v]) continue;
        const Vec3& place = part.points()[v];
        const double height =
            std::min(found.twins.tubes[0].height(place), found.twins.tubes[1].height(place));
        if (height <= report.lost) continue;
        report.lost = height;
        report.lost_at = place;
    }
}

/// Radius of the ball in which vertices may move: what hardly leaves the zone's ball belongs to it.
double influence_of(const ContactZone& zone) {
    double farthest = zone.reach;
    for (const Vec3& p : zone.part.surface.points())
        farthest = std::max(farthest, (p - zone.centre).norm());
    return farthest;
}

void require_sound(const Surface& before, const Surface& after, const SeparateReport& report,
                   const Progress& progress) {
    const Connectivity was = connectivity(*before.topology), is = connectivity(*after.topology);
    if (is.boundary_loops != was.boundary_loops || (was.manifold && !is.manifold) ||
        (was.oriented && !is.oriented))
        refuse_parting(report.centre);
    std::vector<std::uint8_t> changed(after.triangle_count(), 0);
    std::fill(changed.end() - static_cast<std::ptrdiff_t>(report.replacement), changed.end(), 1);
    if (const auto crossing = crossing_of(after, changed, progress))
        refuse("separate-crosses", "separate", *crossing, {},
               {{.operation = "repair", .before = true}});
}

void measure_change(const Surface& before, const Surface& after, SeparateReport& report) {
    const Connectivity was = connectivity(*before.topology), is = connectivity(*after.topology);
    report.components_before = was.components;
    report.components_after = is.components;
    report.genus_before = was.genus.value_or(0);
    report.genus_after = is.genus.value_or(0);
}

}  // namespace

std::array<Vec3, 2> vessel_through(const Surface& surface, const SurfaceDistance& places,
                                   const SeparateParameters& parameters, const Progress& progress) {
    return first_vessel(parted_at(surface, places, parameters, progress).found);
}

Separated separate(const Surface& surface, const SurfaceDistance& places,
                   const SeparateParameters& parameters, const Progress& progress) {
    const auto [found, walls] = parted_at(surface, places, parameters, progress.part(0.0, 0.8));
    SeparateReport report{.centre = found.zone.centre,
                          .influence = influence_of(found.zone),
                          .width = found.bridge.width,
                          .length = found.bridge.length,
                          .gap = walls.gap,
                          .farthest = walls.farthest,
                          .radii = found.bridge.radii};
    report.waist = report.width / (2.0 * std::min(report.radii[0], report.radii[1]));
    report.vessel = first_vessel(found);
    measure_lost(found, walls, report);
    report.replaced = static_cast<std::size_t>(std::ranges::count(found.zone.marked, 1));
    report.replacement = walls.part.surface.triangle_count();
    Separated result{sewn(surface, found.zone.marked, found.zone.part, walls.part), report};
    progress.report(0.8, "looking for crossings");
    require_sound(surface, result.surface, result.report, progress.part(0.8, 1.0));
    measure_change(surface, result.surface, result.report);
    return result;
}

}  // namespace vesselbench
