#include "geometry/vessel/ends/end_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/flow_tree.h"
#include "geometry/vessel/ends/patch_shape.h"
#include "geometry/vessel/ends/stub_sections.h"

namespace vesselbench {

namespace {

constexpr int kSamples = 24;
/// Sections of longer vessels say nothing of a neck [diameters].
constexpr double kLongestNecked = 4.0;
/// Shorter branches without a line have no neck [diameters].
constexpr double kShortestNecked = 0.5;
/// Lengths, ratios and counts beyond these factors say no more.
constexpr double kMostRatio = 8.0;
constexpr double kUsualAcross = 8.0;
/// Width of a vessel beside an oblique closure's at 50 degrees [-].
constexpr double kOblique = 0.8;
constexpr double kMostNeed = 2.0;

/// The widest vessel of the tree, along its course, without one branch.
double widest_course(const std::vector<double>& courses, std::size_t without) {
    double widest = 0.0;
    for (std::size_t b = 0; b < courses.size(); ++b)
        if (b != without) widest = std::max(widest, courses[b]);
    return widest;
}

/// Along the line of a tip's branch. \param courses diameters of all branches [mm]
void measure_line(const EndScene& scene, const std::vector<double>& courses, std::size_t tip,
                  EndProfile& profile) {
    const CenterlineGraph& graph = scene.graph;
    const std::size_t index = branch_of_tip(graph, tip), root = other_node(graph, index, tip);
    const CenterlineBranch& branch = graph.branches[index];
    const double whole = branch_length(branch);
    const double zone = std::min(furcation_zone_end(graph, index, root), whole);
    profile.length = whole - parents_exit(graph, index, root);
    if (profile.kind == EndKind::Blind) profile.length += graph.nodes[tip].radius;
    const double from = std::min(zone, 0.5 * whole);
    std::vector<double> diameters;
    double narrowest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSamples; ++k) {
        const double s = from + (whole - from) * (k + 0.5) / kSamples;
        const double d = 2.0 * radius_at(branch, place_from_node(graph, index, root, s).abscissa);
        diameters.push_back(d);
        narrowest = std::min(narrowest, d);
        profile.neck = std::max(profile.neck, d / narrowest);
    }
    profile.diameter = median(diameters);
    profile.widest = *std::ranges::max_element(diameters);
    const std::span<const double> all(diameters);
    profile.inner = mean(all.first(kSamples / 3));
    profile.taper = profile.inner > 0.0 ? mean(all.last(kSamples / 3)) / profile.inner : 1.0;
    profile.straight = -1.0;
    for (const std::size_t other : graph.nodes[root].branches)
        if (other != index) {
            profile.add_other(courses[other]);
            profile.straight = std::max(
                profile.straight,
                -direction_from(graph, other, root).dot(direction_from(graph, index, root)));
        }
    if (!(profile.parent > 0.0)) profile.inner = profile.diameter;  // that of both ends
    profile.tree = widest_course(courses, index);
    if (profile.parent > 0.0 && profile.length < kLongestNecked * profile.diameter)
        profile.neck = std::max(profile.neck, section_rise(scene.surface, graph, tip));
}

void measure_sections(const EndScene& scene, const Stub& stub, EndProfile& profile) {
    double narrowest = std::numeric_limits<double>::infinity(), inscribed = 0.0;
    for (const StubSection& section : stub_sections(scene.surface, scene.graph, stub)) {
        narrowest = std::min(narrowest, section.diameter);
        profile.neck = std::max(profile.neck, section.diameter / narrowest);
        inscribed = std::max(inscribed, section.inscribed);
        profile.widest = std::max(profile.widest, section.diameter);
    }
    if (inscribed > 0.0) profile.diameter = inscribed;
}

/// Edge of the voxels, or of the surface's triangles [mm].
double element_size(const EndScene& scene) {
    return scene.image ? scene.image->voxel() : mean_edge_length(scene.surface);
}

/// The vessels that a stub leaves: those at the furcation in whose sphere its root lies, or the one
/// that passes.
void add_others(const CenterlineGraph& graph, const std::vector<double>& courses, const Stub& stub,
                EndProfile& profile) {
    const auto line = nearest_place(graph, stub.root);
    if (!line) return;
    const CenterlineBranch& branch = graph.branches[line->place.branch];
    for (const std::size_t node : {branch.start_node, branch.end_node}) {
        const CenterlineNode& at = graph.nodes[node];
        if (at.is_tip() || (at.position - stub.root).norm() > at.radius) continue;
        for (const std::size_t other : at.branches) profile.add_other(courses[other]);
        return;
    }
    for (int side = 0; side < 2; ++side) profile.add_other(courses[line->place.branch]);
}

/// Of the circle with the area of an open border, or of a cap [mm]; 0: there is none.
double closure_width(const Surface& surface, const SurfaceEnd& end) {
    if (end.patch) return end.closure;
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < end.rim.size(); ++i)
        area += 0.5 * (surface.points()[end.rim[i]] - end.centre)
                          .cross(surface.points()[end.rim[(i + 1) % end.rim.size()]] - end.centre);
    return 2.0 * std::sqrt(area.norm() / std::numbers::pi);
}

/// A rim or cap where no line ends is a hole or a label in the side of the vessel that passes.
void measure_lineless(const EndScene& scene, const std::vector<double>& courses,
                      const SurfaceEnd& end, EndProfile& profile) {
    profile.diameter = profile.widest = profile.inner = closure_width(scene.surface, end);
    profile.tree = widest_course(courses, courses.size());
    const auto line = nearest_place(scene.graph, end.centre);
    for (int side = 0; line && side < 2; ++side) profile.add_other(courses[line->place.branch]);
}

/// Who left two ends open, or named them, has cut the vessels: what is closed beside them was left
/// closed.
void add_cuts(const std::vector<SurfaceEnd>& ends, EndProfiles& profiles) {
    double cut = 0.0, all = 0.0, faces = 0.0;
    std::size_t count = 0;
    for (const EndProfile& stub : profiles.stubs) all += std::pow(stub.diameter, 3.0);
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const EndProfile& profile = profiles.ends[e];
        const double cube = std::pow(profile.diameter, 3.0);
        all += cube;
        if (ends[e].tip) faces += profile.upright();
        if (!profile.is_left_open()) continue;
        cut += cube;
        if (ends[e].tip) ++count;
    }
    for (auto* list : {&profiles.ends, &profiles.stubs})
        for (EndProfile& profile : *list)
            if (!profile.is_left_open()) {
                profile.cut_beside = all > 0.0 ? cut / all : 0.0;
                profile.cuts_beside = count;
                profile.faces_beside = faces - profile.upright();
            }
}

EndKind kind_of(const EndScene& scene, const SurfaceEnd& end) {
    if (!end.patch) return end.rim.empty() ? EndKind::Blind : EndKind::Rim;
    if (scene.surface.patches[*end.patch].kind != PatchKind::Cut) return EndKind::Named;
    const bool border =
        scene.border_cuts &&
        (!scene.image || scene.image->ends_at(patch_shape(scene.surface, *end.patch).plane));
    return border ? EndKind::Border : EndKind::Face;
}

/// The line may end in a corner of an oblique or blunt closure, where it is narrow.
void measure_closure(const Surface& surface, const SurfaceEnd& end, EndProfile& profile) {
    profile.closure = closure_width(surface, end);
    if (end.patch && profile.diameter > 0.0) {
        profile.cap_share = profile.closure / profile.diameter;
        profile.cap_rise = wall_rise_deg(surface, *end.patch);
    }
    profile.diameter = std::max(profile.diameter, kOblique * profile.closure);
    profile.widest = std::max(profile.widest, profile.diameter);
}

EndProfile end_profile(const EndScene& scene, const std::vector<double>& courses,
                       const SurfaceEnd& end) {
    EndProfile profile;
    profile.kind = kind_of(scene, end);
    if (end.tip)
        measure_line(scene, courses, *end.tip, profile);
    else
        measure_lineless(scene, courses, end, profile);
    measure_closure(scene.surface, end, profile);
    return profile;
}

EndProfile stub_profile(const EndScene& scene, const std::vector<double>& courses,
                        const Stub& stub) {
    EndProfile profile{
        .length = stub.length, .diameter = 2.0 * stub.widest, .widest = 2.0 * stub.widest};
    add_others(scene.graph, courses, stub, profile);
    profile.tree = widest_course(courses, courses.size());
    if (const auto line = nearest_place(scene.graph, stub.root))
        profile.straight =
            std::abs(tangent_at(scene.graph.branches[line->place.branch], line->place.abscissa)
                         .dot((stub.tip - stub.root).stableNormalized()));
    if (profile.length > kShortestNecked * profile.diameter) measure_sections(scene, stub, profile);
    return profile;
}

double log_ratio(double a, double b) {
    if (!(a > 0.0 && b > 0.0)) return 0.0;
    return std::clamp(std::log(a / b), -std::log(kMostRatio), std::log(kMostRatio));
}

/// How far a furcation of vessels is from Murray's law, |ln(inflow / outflow)|, if the one that
/// fits best is the inflow.
double imbalance(const std::vector<double>& cubes) {
    double sum = 0.0, least = std::numeric_limits<double>::infinity();
    for (const double cube : cubes) sum += cube;
    for (const double cube : cubes)
        if (sum > cube && cube > 0.0)
            least = std::min(least, std::abs(std::log(cube / (sum - cube))));
    return std::isfinite(least) ? least : 0.0;
}

/// Of the wall over a cap, as a share of a right angle [-].
double lean_of(const EndProfile& profile) {
    return (90.0 - profile.cap_rise) / 90.0;
}

}  // namespace

double EndProfile::upright() const {
    if (kind != EndKind::Face) return 0.0;
    // Towards a flat place of a dome the wall never flares, as it may towards a cut.
    return std::clamp(1.0 - lean_of(*this) / kMostLean, 0.0, 1.0);
}

double EndProfile::need() const {
    if (others.size() < 2) return 0.0;
    std::vector<double> all = others;
    all.push_back(diameter * diameter * diameter);
    return imbalance(others) - imbalance(all);
}

EndFeatures features_of(const EndProfile& p) {
    const bool branch = p.parent > 0.0;
    // A plane that has cut a vessel shows that it went on there, however short it is.
    const double uncut = p.is_cut() ? 0.0 : 1.0 - p.upright();
    const auto unless_cut = [uncut](double value) { return uncut * value; };
    const auto of_kind = [&](EndKind kind) { return p.kind == kind ? 1.0 : 0.0; };
    const double length = branch ? log_ratio(std::max(p.length, 1e-6 * p.diameter), p.diameter)
                                 : std::log(kMostRatio);
    const double surplus =
        branch ? std::max(0.0, log_ratio(p.diameter, std::cbrt(p.other_flow()))) : 0.0;
    const double border = of_kind(EndKind::Border), face = of_kind(EndKind::Face);
    const double share = log_ratio(p.cap_share, 1.0), lean = lean_of(p);
    return {1.0,
            unless_cut(length),
            unless_cut(std::max(0.0, -length)),
            unless_cut(log_ratio(p.neck, 1.0)),
            branch ? log_ratio(p.diameter, p.parent) : 0.0,
            unless_cut(surplus),
            log_ratio(p.diameter, p.tree),
            unless_cut(std::clamp(p.need(), -kMostNeed, kMostNeed)),
            unless_cut(log_ratio(p.widest, p.diameter)),
            unless_cut(log_ratio(p.taper, 1.0)),
            unless_cut(p.straight),
            std::min(0.0, log_ratio(p.across, kUsualAcross)),
            p.is_left_open() ? 1.0 : 0.0,
            border,
            border * share,
            border * lean,
            face,
            face * share,
            face * lean,
            p.upright(),
            p.cut_beside,
            p.cuts_beside >= kFewestCuts ? 1.0 : 0.0,
            unless_cut(std::min(1.0, p.faces_beside / kFewestCuts))};
}

EndProfiles profiles_of(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                        const std::vector<Stub>& stubs, const Progress& progress) {
    EndProfiles profiles;
    const std::vector<double> courses = course_diameters(scene.graph);
    for (const SurfaceEnd& end : ends) {
        progress.check_cancelled();
        profiles.ends.push_back(end_profile(scene, courses, end));
    }
    for (const Stub& stub : stubs) {
        progress.check_cancelled();
        profiles.stubs.push_back(stub_profile(scene, courses, stub));
    }
    const double element = element_size(scene);
    for (auto* list : {&profiles.ends, &profiles.stubs})
        for (EndProfile& profile : *list) profile.across = profile.diameter / element;
    add_cuts(ends, profiles);
    return profiles;
}

}  // namespace vesselbench
