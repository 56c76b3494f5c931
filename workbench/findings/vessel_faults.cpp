// What the vessels' courses and ends show.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel/handles.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/artefacts/short_branches.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/frayed_trunks.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/rim_shape.h"
#include "geometry/vessel/repair/widen.h"
#include "meshing/products/print_check.h"
#include "workbench/findings/branch_readings.h"
#include "workbench/findings/detectors.h"
#include "workbench/operations/shared/handle_warnings.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostPlaces = 20;

Remedy opened_at(const Vec3& tip) {
    return {.operation = "clip-opening",
            .arguments = {{"tip", coordinates_argument(tip)}, {"strict", "true"}}};
}

/// How long a handle's neck is beside its waist: the part of its line that lies outside the vessels
/// it joins [widths of the waist]. Two vessels that touch have next to none; a ring's vessel is
/// longer than it is wide.
double neck_length(const CenterlineGraph& graph, const SurfaceHandle& handle) {
    const auto nearest = nearest_place(graph, handle.centre);
    if (!nearest) return 0.0;
    const CenterlineBranch& branch = graph.branches[nearest->place.branch];
    const double free = branch_length(branch) -
                        parents_exit(graph, nearest->place.branch, branch.start_node) -
                        parents_exit(graph, nearest->place.branch, branch.end_node);
    return std::max(free, 0.0) / handle.width;
}

/// A ring of the surface is a ring of vessels, or two vessels that the image has joined.
std::vector<Reading> handle_readings(double touching, double neck, bool measured) {
    std::vector<Reading> readings = {
        {.key = "contact", .name = "vessels that touch", .odds = touching},
        {.key = "ring", .name = "ring of vessels", .anatomy = true, .odds = 1.0 - touching}};
    if (measured)
        readings[neck < 1.0 ? 0 : 1].evidence = {
            {.code = neck < 1.0 ? "reading-no-bridge" : "reading-bridge",
             .figures = {{"ratio", neck}}}};
    std::ranges::stable_sort(readings, std::greater{}, &Reading::odds);
    return readings;
}

struct FlatEnd {
    Plane plane;
    double diameter = 0.0;  ///< [mm]
    std::string name;       ///< of a cap; empty: an open rim
};

std::vector<FlatEnd> flat_ends(const Surface& surface) {
    std::vector<FlatEnd> ends;
    for (std::size_t p = 1; p < surface.patches.size(); ++p) {
        if (surface.patches[p].kind == PatchKind::Wall) continue;
        const PatchShape shape = patch_shape(surface, p);
        if (is_flat(shape))
            ends.push_back({shape.plane, shape.diameter(), surface.patches[p].name});
    }
    for (const auto& loop : surface.topology->boundary_loops())
        if (const RimShape rim = rim_shape(surface, loop); rim.is_good())
            ends.push_back({rim.plane, rim.diameter(), ""});
    return ends;
}

/// The vessel's axis where an end was cut; none: it cannot be measured.
std::optional<OpeningAxis> axis_at(const Surface& surface, const FlatEnd& end) {
    const auto by_sections = axis_inward(surface, end.plane, end.diameter);
    if (!by_sections) return std::nullopt;
    const auto by_wall = axis_by_wall(surface, end.plane, *by_sections);
    return by_wall ? by_wall : by_sections;
}

}  // namespace

std::vector<Finding> find_handles(FindingSubject& subject, const Progress& progress) {
    constexpr double kEven = 1.5, kSure = 0.75;  // of neck_length()
    constexpr int kMostHandles = 12;             // of more, noise is part of the lumen
    const Surface& surface = subject.surface();
    const int genus = connectivity(*surface.topology).genus.value_or(0);
    if (genus <= 0 || genus > kMostHandles) return {};
    const bool has_lines = subject.has_lines(progress);
    std::vector<Finding> findings;
    for (const SurfaceHandle& handle : handles_of(surface, progress)) {
        Diagnostic evidence = handle_warning(handle);
        const bool artefact = evidence.code == "handle-artefact";
        const double neck = has_lines ? neck_length(*subject.lines(progress).graph, handle) : kEven;
        const double certainty =
            artefact ? certainty_of(0.0, kEven, kSure) : certainty_of(neck, kEven, kSure);
        findings.push_back({.kind = "handle",
                            .place = handle.centre,
                            .size = handle.width,
                            .certainty = certainty,
                            .evidence = std::move(evidence),
                            .readings = artefact ? std::vector<Reading>{}
                                                 : handle_readings(certainty, neck, has_lines)});
    }
    return findings;
}

std::vector<Finding> find_contacts(FindingSubject& subject, const Progress& progress) {
    // In the image nothing parts walls that are a voxel apart; on a surface alone, three edges.
    constexpr double kVoxels = 1.0, kEdges = 3.0;
    constexpr double kEven = 1.2, kSure = 0.9;  // of the limit
    const auto& sampling = subject.scene().sampling;
    const double limit =
        sampling ? kVoxels * sampling->spacing.maxCoeff() : kEdges * subject.mean_edge();
    std::vector<Finding> findings;
    for (const FacingPlaces& gap : narrow_gaps(subject.surface(), 1.3 * limit, progress)) {
        findings.push_back(
            {.kind = "contact",
             .place = 0.5 * (gap.from + gap.to),
             .size = limit,
             .certainty = certainty_of(gap.distance / limit, kEven, kSure),
             .evidence = {.code = "found-contact",
                          .figures = {{"distance_mm", gap.distance}, {"limit_mm", limit}}}});
        if (findings.size() == kMostPlaces) break;
    }
    return findings;
}

std::vector<Finding> find_threads(FindingSubject& subject, const Progress& progress) {
    constexpr double kVoxels = 0.5;  // as the operation's own default
    constexpr double kEven = 1.1, kSure = 0.9;
    const auto& sampling = subject.scene().sampling;
    if (!sampling) return {};  // nothing says what the image can show
    const double limit = kVoxels * sampling->spacing.minCoeff();
    if (!(limit < bounds(subject.surface()).diagonal())) return {};
    std::vector<Finding> findings;
    for (const NarrowPlace& narrow : narrow_places(subject.surface(), limit, progress)) {
        findings.push_back(
            {.kind = "thread",
             .place = narrow.place,
             .size = limit,
             .certainty = certainty_of(narrow.width / limit, kEven, kSure),
             .evidence = {.code = "found-thread",
                          .figures = {{"width_mm", narrow.width}, {"limit_mm", limit}},
                          .remedies = {{.operation = "widen",
                                        .arguments = {{"width", formatted(limit)}}}}}});
        if (findings.size() == kMostPlaces) break;
    }
    return findings;
}

std::vector<Finding> find_stubs(FindingSubject& subject, const Progress& progress) {
    constexpr double kEven = 2.2, kSure = 1.7;            // length over diameter
    constexpr double kEvenRise = 0.35, kSureRise = 0.6;   // of one without a line [radii]
    constexpr double kEvenWidth = 2.0, kSureWidth = 3.0;  // of one without a line [mean edges]
    const auto& lines = subject.lines(progress);
    std::vector<Finding> findings;
    for (const ShortBranch& branch :
         short_branches(subject.surface(), *lines.graph, *lines.stubs, progress)) {
        const double slender = certainty_of(branch.length / branch.diameter, kEven, kSure);
        const double bulge =
            std::min(certainty_of(2.0 * branch.length / branch.parent, kEvenRise, kSureRise),
                     certainty_of(branch.diameter / subject.mean_edge(), kEvenWidth, kSureWidth));
        const auto verdict = subject.verdict_at(branch.tip, progress);
        if (!verdict && !branch.has_line) continue;  // it is part of another end
        Finding finding{.kind = "stub",
                        .place = branch.tip,
                        .size = std::max(branch.length, 0.5 * branch.diameter),
                        .certainty = branch.has_line ? slender : std::min(slender, bulge),
                        .evidence = {.code = "found-stub",
                                     .figures = {{"length_mm", branch.length},
                                                 {"diameter_mm", branch.diameter},
                                                 {"parent_mm", branch.parent}}},
                        .readings = branch_readings(verdict)};
        if (branch.has_line)
            finding.evidence.remedies = {
                {.operation = "remove-branch",
                 .arguments = {{"tip", coordinates_argument(branch.tip)}}}};
        findings.push_back(std::move(finding));
        if (findings.size() == kMostPlaces) break;
    }
    return findings;
}

std::vector<Finding> find_oblique_ends(FindingSubject& subject, const Progress& progress) {
    constexpr double kLeast = 6.0, kEven = 8.0, kSure = 13.0;  // [deg]
    const Surface& surface = subject.surface();
    std::vector<Finding> findings;
    for (const FlatEnd& end : flat_ends(surface)) {
        progress.check_cancelled();
        const auto axis = axis_at(surface, end);
        if (!axis) continue;
        const double tilt = axis->tilt_deg - 2.0 * axis->doubt_deg;
        if (tilt < kLeast) continue;
        findings.push_back({.kind = "oblique-end",
                            .place = end.plane.point,
                            .size = 0.5 * end.diameter,
                            .certainty = certainty_of(tilt, kEven, kSure),
                            .evidence = {.code = "found-oblique-end",
                                         .figures = {{"tilt_deg", axis->tilt_deg},
                                                     {"doubt_deg", axis->doubt_deg},
                                                     {"diameter_mm", end.diameter}},
                                         .remedies = {opened_at(end.plane.point)}}});
    }
    return findings;
}

std::vector<Finding> find_frayed_ends(FindingSubject& subject, const Progress& progress) {
    constexpr double kEven = 2.0, kSure = 3.0;  // threads
    const auto& lines = subject.lines(progress);
    const LinesWithoutFrays whole = without_frays(subject.surface(), *lines.graph, *lines.stubs);
    std::vector<Finding> findings;
    for (const FrayedTrunk& trunk : whole.trunks) {
        const Vec3 tip = whole.graph.nodes[trunk.tip].position;
        double reach = tip_radius(whole.graph, trunk.tip);
        double widest = 0.0;
        for (const ThinEnd& end : trunk.ends) {
            reach = std::max(reach, (end.place - tip).norm());
            widest = std::max(widest, end.diameter);
        }
        findings.push_back(
            {.kind = "frayed-end",
             .place = tip,
             .size = reach,
             .certainty = certainty_of(static_cast<double>(trunk.ends.size()), kEven, kSure),
             .evidence = {.code = "found-frayed-end",
                          .figures = {{"threads", static_cast<double>(trunk.ends.size())},
                                      {"diameter_mm", widest},
                                      {"trunk_mm", 2.0 * tip_radius(whole.graph, trunk.tip)}}}});
    }
    return findings;
}

}  // namespace vesselbench
