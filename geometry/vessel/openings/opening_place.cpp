#include "geometry/vessel/openings/opening_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_section.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

namespace {

/// Steps along the branch in tip radii: for the first whole section, then for straight places.
constexpr double kSearchStep = 0.15;
constexpr double kCandidateStep = 0.4;
constexpr int kCandidates = 9;
/// Distance from the first whole section to the first candidate place [tip radii].
constexpr double kMargin = 0.25;
constexpr double kBlindMargin = 0.5;
/// A rounded end is found whole too deep by up to this much [tip radii].
constexpr double kFoundTooDeep = 0.25;
/// Behind a rounded end's outermost place, its sections still grow: to 0.85 of their area there, as
/// is_whole asks, and in full 0.39 radii farther inward [tip radii].
constexpr double kRounded = kFoundTooDeep + 0.39;
/// The line's last stretch may turn: directions are measured at least this far inward [tip radii].
constexpr double kSteady = 1.0;
/// Largest fraction of a branch that is searched for the first whole section; in a vessel without
/// furcations, at each end.
constexpr double kMostOfBranch = 0.6;
constexpr double kMostOfVessel = 0.2;
constexpr double kMostOfObliqueVessel = 0.65;  // if its end is cut very obliquely
/// Fraction of a branch, from its furcation's end, that may be given up for a straighter place:
/// less than a tenth, since the section's place is known to a fraction of a radius only.
constexpr double kGivenUp = 0.08;
/// A furcation whose other branch is too short or too thin for a line of its own ends the branch,
/// too: the vessel's sections are this much wider there than some steps before and behind.
constexpr double kBulge = 1.1;
constexpr double kBulgeStep = 0.5;     // tip radii
constexpr double kBulgeReach = 15.0;   // tip radii
constexpr std::size_t kBulgeFrom = 3;  // steps from the widest section, and as many behind these
/// Bend assumed where the axis cannot be measured [deg].
constexpr double kUnmeasuredCost = 60.0;
/// Bend that weighs as much as one radius of vessel given up [deg].
constexpr double kCostPerRadius = 5.0;
/// A direction in doubt counts like a bend of so many times the doubt: deeper in, the vessel on
/// both sides of the cut shows it.
constexpr double kDoubtWeight = 4.0;
/// A place deeper in has to be better by more than this [deg]: less says nothing, and gives up
/// vessel.
constexpr double kWorthMoving = 1.0;
/// A section is whole if it is hardly larger half a radius farther inward.
constexpr double kWholeShare = 0.85;
/// Where none is, this much of it has to be there.
constexpr double kHalfWholeShare = 0.5;
/// Across a furcation, a cut is searched up to this many radii behind it.
constexpr double kBehindFurcation = 1.0;
constexpr int kMostTurns = 12;
constexpr double kConvergedTilt = 0.02;  // [deg]

/// One branch seen from one of its nodes, the end.
class BranchFromEnd {
public:
    BranchFromEnd(const Surface& surface, const CenterlineGraph& graph, std::size_t tip)
        : BranchFromEnd(surface, graph, tip, branch_of_tip(graph, tip), tip_radius(graph, tip)) {}

    BranchFromEnd(const Surface& surface, const CenterlineGraph& graph, std::size_t end,
                  std::size_t branch, double radius_there)
        : graph_(graph),
          tip_(end),
          branch_(branch),
          radius(radius_there),
          length(branch_length(graph.branches[branch_])),
          near_(part_near(surface, graph.nodes[end].position, reach())) {}

    /// \param s [mm] from the end; negative: straight on beyond it
    Vec3 position(double s) const {
        if (s < 0.0) return graph_.nodes[tip_].position - s * outward(0.0);
        return point_at(graph_.branches[branch_],
                        place_from_node(graph_, branch_, tip_, s).abscissa);
    }

    Vec3 outward(double s) const {
        const double steady = std::max(s, std::min(kSteady * radius, 0.5 * length));
        const BranchPlace place = place_from_node(graph_, branch_, tip_, std::min(steady, length));
        const Vec3 forward = tangent_at(graph_.branches[branch_], place.abscissa, radius);
        return graph_.branches[branch_].start_node == tip_ ? Vec3(-forward) : forward;
    }

    /// Largest arc length from the tip at which a cut may be placed: up to where the branch becomes
    /// a separate vessel, or in the outer part of a stub that never does.
    double reach_of_cut() const {
        const std::size_t other = other_node(graph_, branch_, tip_);
        if (graph_.nodes[other].is_tip()) return kMostOfVessel * length;
        const double own = own_length();
        return std::min(std::max(own, 0.5 * length), kMostOfBranch * length);
    }

    /// Without the furcation's zone [mm].
    double own_length() const {
        const std::size_t other = other_node(graph_, branch_, tip_);
        return length - furcation_zone_end(graph_, branch_, other);
    }

    /// The branch's part that is known to be a vessel without side branches [mm]: own_length, or up
    /// to a bulge of its wall.
    double plain_length(double from) const {
        const double whole = own_length(), step = kBulgeStep * radius;
        std::vector<double> widths;
        for (double s = from; s < std::min(whole, kBulgeReach * radius); s += step) {
            const auto curve = section({position(s), outward(s)});
            if (!curve) break;
            widths.push_back(curve->diameter());
        }
        for (std::size_t k = 2 * kBulgeFrom; k + 2 * kBulgeFrom < widths.size(); ++k)
            if (is_bulge(widths, k))
                return std::min(whole, from + static_cast<double>(k) * step - radius);
        return whole;
    }

    /// How far the vessel goes on beyond the line's tip [mm].
    double gap() const {
        const Vec3 tip = graph_.nodes[tip_].position, way = outward(0.0);
        double farthest = 0.0;
        for (const Vec3& p : near_.points())
            if ((p - tip).norm() < 2.0 * radius) farthest = std::max(farthest, (p - tip).dot(way));
        return farthest;
    }

    /// How far a very oblique end may push the cut: up to the furcation, or past a short vessel's
    /// middle. If it is too far, it meets the cut at the other end, which then reports it.
    double utmost_cut() const {
        const std::size_t other = other_node(graph_, branch_, tip_);
        if (graph_.nodes[other].is_tip()) return kMostOfObliqueVessel * length;
        return std::max(reach_of_cut(), length - furcation_zone_end(graph_, branch_, other));
    }

    /// A vessel that can go: narrower than the one that it leaves, and long enough to tell.
    bool is_side_branch() const {
        const auto blind = blind_branch(graph_, tip_);
        return blind && blind->widest < std::min(blind->parent, blind->length) &&
               !is_trunk(graph_, tip_);
    }

    /// True if there is neither an open border nor a known cap at the tip: the end may be rounded.
    bool is_blind() const {
        const Vec3 tip = graph_.nodes[tip_].position;
        const auto& border = near_.topology->boundary_vertices();
        for (TriangleId t = 0; t < near_.triangle_count(); ++t)
            for (const VertexId v : near_.triangles()[t])
                if ((near_.patch_of(t).kind != PatchKind::Wall || border[v]) &&
                    (near_.points()[v] - tip).norm() < 1.5 * radius)
                    return false;
        return true;
    }

    /// The closed curve around the plane's point that lies entirely on the wall.
    std::optional<SectionCurve> section(const Plane& plane) const {
        auto curve = whole_section_at(near_, plane);
        if (!curve) return std::nullopt;
        for (const TriangleId t : curve->triangles)
            if (near_.patch_of(t).kind != PatchKind::Wall) return std::nullopt;
        return curve;
    }

    /// True if the section is closed and, at an end that may be rounded, has this share of its full
    /// area.
    bool is_whole(double s, bool blind, double share = kWholeShare) const {
        const Vec3 normal = outward(s);
        const auto here = section({position(s), normal});
        if (!blind) return here.has_value();
        const auto inward = section({position(s) - 0.5 * radius * normal, normal});
        return here && inward && std::abs(here->area) >= share * std::abs(inward->area);
    }

    /// The plane at s whose normal is the axis measured from there; empty without a closed section.
    std::optional<OpeningPlace> place(double s) const {
        auto found = place_by_sections(s);
        if (found) refine(*found, 0.0);
        return found;
    }

    /// Takes the wall's direction, if it shows it better than sections do.
    /// \param whole where the wall becomes a tube, inward from the place [mm]
    void refine(OpeningPlace& place, double whole) const {
        if (!place.measured) return;
        auto by_sections = axis_inward(near_, place.plane, place.diameter);
        if (!by_sections) return;
        by_sections->doubt_deg = place.doubt_deg;  // sections beyond it count, too
        const auto axis = axis_by_wall(near_, place.plane, *by_sections, whole);
        if (!axis) return;
        const auto curve = section({place.plane.point, axis->direction});
        if (!curve) return;
        place.plane = {curve->centroid, axis->direction};
        place.diameter = curve->diameter();
        place.tilt_deg = 0.0;
        place.bend_deg = axis->bend_deg;
        place.doubt_deg = axis->doubt_deg;
    }

    /// The same place, measured by sections only.
    /// \param beyond how far sections are whole beyond it [mm]
    std::optional<OpeningPlace> place_by_sections(double s, double beyond = 0.0) const {
        OpeningPlace found{
            .tip = graph_.nodes[tip_].position, .plane = {position(s), outward(s)}, .distance = s};
        double best_tilt = 180.0;
        Plane plane = found.plane;
        for (int turn = 0; turn < kMostTurns && best_tilt > kConvergedTilt; ++turn) {
            const auto curve = section(plane);
            if (!curve) break;
            plane.point = curve->centroid;
            const auto axis = axis_inward(near_, plane, curve->diameter(), beyond);
            if (turn == 0 || (axis && axis->tilt_deg < best_tilt)) {
                found.measured = axis.has_value();
                found.plane = plane;
                found.diameter = curve->diameter();
                found.tilt_deg = axis ? axis->tilt_deg : 0.0;
                found.bend_deg = axis ? axis->bend_deg : 0.0;
                found.doubt_deg = axis ? axis->doubt_deg : 0.0;
                if (axis) best_tilt = axis->tilt_deg;
            }
            if (!axis) break;
            plane.normal = axis->direction;
        }
        return found.diameter > 0.0 ? std::optional(found) : std::nullopt;
    }

private:
    static bool is_bulge(const std::vector<double>& widths, std::size_t k) {
        double before = 0.0, behind = 0.0;
        for (std::size_t i = kBulgeFrom; i <= 2 * kBulgeFrom; ++i) {
            before += widths[k - i] / (kBulgeFrom + 1.0);
            behind += widths[k + i] / (kBulgeFrom + 1.0);
        }
        return widths[k] >= widths[k - 1] && widths[k] >= widths[k + 1] &&
               widths[k] > kBulge * std::max(before, behind);
    }

    double reach() const {
        return radius * (6.0 + kCandidateStep * kCandidates) + std::min(length, 6.0 * radius);
    }

    const CenterlineGraph& graph_;
    std::size_t tip_, branch_;

public:
    double radius, length;  ///< [mm]

private:
    Surface near_;
};

[[noreturn]] void fail_without_section(const Vec3& tip, bool side_branch) {
    Diagnostic found{.code = "no-whole-section", .place = tip};
    if (side_branch)
        found.remedies = {
            {.operation = "remove-branch", .arguments = {{"tip", coordinates_argument(tip)}}}};
    else
        found.words["advice"] = "give the distance from its tip";
    throw DiagnosedFailure(std::move(found));
}

/// The first whole section from the tip.
double first_whole(const BranchFromEnd& branch, bool blind, const Vec3& tip) {
    const double utmost = blind ? branch.reach_of_cut() : branch.utmost_cut();
    double first = 0.5 * kSearchStep * branch.radius;
    while (first < utmost && !branch.is_whole(first, blind)) first += kSearchStep * branch.radius;
    if (first >= utmost) fail_without_section(tip, branch.is_side_branch());
    return first;
}

/// Where the vessel is whole for certain: the search finds a rounded end's place a little too deep,
/// and a line may begin inside its vessel's end.
double outermost_whole(const BranchFromEnd& branch, bool blind, double first) {
    const double step = kSearchStep * branch.radius;
    double s = first;
    if (first < step)
        for (s = 0.0; s - step > -branch.gap() && branch.is_whole(s - step, blind);) s -= step;
    return blind ? s - kFoundTooDeep * branch.radius : s;
}

OpeningPlace place_by_itself(const BranchFromEnd& branch, const Vec3& tip) {
    const bool blind = branch.is_blind();
    const double whole = first_whole(branch, blind, tip);
    const double plain = branch.plain_length(whole);
    const double outermost = outermost_whole(branch, blind, whole);
    const double tube_from = blind ? outermost + kRounded * branch.radius : outermost;
    const double deepest = outermost + kGivenUp * (plain - outermost);
    const double last = std::max(whole, deepest);
    const double first = std::min(whole + (blind ? kBlindMargin : kMargin) * branch.radius, last);
    std::vector<std::pair<double, OpeningPlace>> found;  // by cost, from the tip inward
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kCandidates; ++k) {
        const double s =
            std::min(first + k * kCandidateStep * branch.radius, std::max(first, deepest));
        const auto place = branch.place_by_sections(s, s - first);
        if (place) {
            const double bent = place->measured ? place->bend_deg + place->tilt_deg +
                                                      kDoubtWeight * place->doubt_deg
                                                : kUnmeasuredCost;
            found.emplace_back(bent + kCostPerRadius * (s - first) / branch.radius, *place);
            least = std::min(least, found.back().first);
        }
        if (s >= deepest) break;
    }
    const auto best = std::ranges::find_if(
        found, [&](const auto& at) { return at.first <= least + kWorthMoving; });
    if (best == found.end())
        throw DiagnosedFailure({.code = "no-closed-section",
                                .place = tip,
                                .remedies = {{.arguments = {{"distance", ""}}}}});
    OpeningPlace& place = best->second;
    branch.refine(place, tube_from - place.distance);
    place.share = place.distance / branch.length;
    return place;
}

/// Places from the end inward, up to a distance from it; the first one that is accepted.
std::optional<OpeningPlace> first_accepted(const BranchFromEnd& branch, double utmost,
                                           const PlaceTest& accepts) {
    const bool blind = branch.is_blind();
    for (double s = 0.5 * kSearchStep * branch.radius; s < utmost;
         s += kSearchStep * branch.radius) {
        if (!branch.is_whole(s, blind, kHalfWholeShare)) continue;
        auto place = branch.place(s);
        if (!place) continue;
        place->share = s / branch.length;
        if (accepts(*place)) return place;
    }
    return std::nullopt;
}

}  // namespace

OpeningPlace choose_opening_place(const Surface& surface, const CenterlineGraph& graph,
                                  std::size_t tip, std::optional<double> distance) {
    const Vec3 at = graph.nodes.at(tip).position;
    const BranchFromEnd branch(surface, graph, tip);
    if (!distance) return place_by_itself(branch, at);
    if (*distance > branch.length)
        throw DiagnosedFailure({.code = "distance-beyond-branch",
                                .place = at,
                                .figures = {{"length_mm", branch.length}},
                                .remedies = {{.arguments = {{"distance", ""}}}}});
    const auto place = branch.place(*distance);
    if (!place)
        throw DiagnosedFailure({.code = "no-section-at-distance",
                                .place = at,
                                .figures = {{"distance_mm", *distance}},
                                .remedies = {{.arguments = {{"distance", ""}}}}});
    return *place;
}

std::optional<OpeningPlace> nearest_opening_place(const Surface& surface,
                                                  const CenterlineGraph& graph, std::size_t tip,
                                                  const PlaceTest& accepts) {
    const BranchFromEnd branch(surface, graph, tip);
    return first_accepted(branch, branch.length, accepts);
}

std::optional<OpeningPlace> place_across_furcation(const Surface& surface,
                                                   const CenterlineGraph& graph, std::size_t tip,
                                                   const PlaceTest& accepts) {
    const std::size_t own = branch_of_tip(graph, tip);
    const std::size_t node = other_node(graph, own, tip);
    if (graph.nodes[node].is_tip()) return std::nullopt;
    const double before = branch_length(graph.branches[own]);
    for (const std::size_t b : graph.nodes[node].branches) {
        if (b == own || graph.branches[b].start_node == graph.branches[b].end_node) continue;
        const double zone = furcation_zone_end(graph, b, node);
        const double radius =
            radius_at(graph.branches[b], place_from_node(graph, b, node, zone).abscissa);
        const BranchFromEnd branch(surface, graph, node, b, radius);
        const auto place =
            first_accepted(branch, std::min(zone + kBehindFurcation * radius, branch.length),
                           [&](const OpeningPlace& found) {
                               OpeningPlace whole = found;
                               whole.tip = graph.nodes[tip].position;
                               whole.distance += before;
                               return accepts(whole);
                           });
        if (!place) continue;
        OpeningPlace found = *place;
        found.tip = graph.nodes[tip].position;
        found.distance += before;
        return found;
    }
    return std::nullopt;
}

}  // namespace vesselbench
