#include "geometry/openings/opening_place.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "geometry/centerlines/branch_queries.h"
#include "geometry/errors.h"
#include "geometry/openings/opening_axis.h"

namespace vesselbench {

namespace {

/// Steps along the branch in tip radii: searching the first whole section, then straight places.
constexpr double kSearchStep = 0.15;
constexpr double kCandidateStep = 0.4;
constexpr int kCandidates = 9;
/// Left between the first whole section and the first place [tip radii].
constexpr double kMargin = 0.25;
/// One radius of vessel given up weighs as much as this much of bend [deg].
constexpr double kCostPerRadius = 5.0;
/// A section is whole when half a radius further inward is hardly larger.
constexpr double kWholeShare = 0.85;
constexpr int kMostTurns = 12;
constexpr double kConvergedTilt = 0.02;  // [deg]

/// One branch seen from its tip.
class BranchFromTip {
public:
    BranchFromTip(const Surface& surface, const CenterlineGraph& graph, std::size_t tip)
        : graph_(graph),
          tip_(tip),
          branch_(branch_of_tip(graph, tip)),
          radius(tip_radius(graph, tip)),
          length(branch_length(graph.branches[branch_])),
          near_(part_near(surface, graph.nodes[tip].position, reach())) {}

    Vec3 position(double s) const {
        return point_at(graph_.branches[branch_],
                        place_from_node(graph_, branch_, tip_, s).abscissa);
    }

    Vec3 outward(double s) const {
        return outward_direction(graph_, tip_, std::min(s, length), radius);
    }

    /// Arc length from the tip up to which the branch is a vessel of its own.
    double own_length() const {
        const auto& branch = graph_.branches[branch_];
        const std::size_t other = branch.start_node == tip_ ? branch.end_node : branch.start_node;
        return length - furcation_zone_end(graph_, branch_, other);
    }

    /// The closed curve round the plane's point that lies wholly on the wall.
    std::optional<SectionCurve> section(const Plane& plane) const {
        auto curve = cross_section_at(near_, plane);
        if (!curve || !curve->closed || !encloses(*curve, plane, plane.point)) return std::nullopt;
        for (const TriangleId t : curve->triangles)
            if (near_.patch_of(t).kind != PatchKind::Wall) return std::nullopt;
        return curve;
    }

    bool is_whole(double s) const {
        const Vec3 normal = outward(s);
        const auto here = section({position(s), normal});
        const auto inward = section({position(s) - 0.5 * radius * normal, normal});
        return here && inward && std::abs(here->area) >= kWholeShare * std::abs(inward->area);
    }

    /// The plane at s whose normal is the axis measured from it; empty without a closed section.
    std::optional<OpeningPlace> place(double s) const {
        OpeningPlace found{
            .tip = graph_.nodes[tip_].position, .plane = {position(s), outward(s)}, .distance = s};
        double best_tilt = 180.0;
        Plane plane = found.plane;
        for (int turn = 0; turn < kMostTurns && best_tilt > kConvergedTilt; ++turn) {
            const auto curve = section(plane);
            if (!curve) break;
            plane.point = curve->centroid;
            const auto axis = axis_inward(near_, plane, curve->diameter());
            if (turn == 0 || (axis && axis->tilt_deg < best_tilt)) {
                found.plane = plane;
                found.diameter = curve->diameter();
                found.tilt_deg = axis ? axis->tilt_deg : 0.0;
                found.bend_deg = axis ? axis->bend_deg : 0.0;
                if (axis) best_tilt = axis->tilt_deg;
            }
            if (!axis) break;
            plane.normal = axis->direction;
        }
        return found.diameter > 0.0 ? std::optional(found) : std::nullopt;
    }

private:
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

[[noreturn]] void fail(const Vec3& tip, const std::string& why) {
    throw AlgorithmFailure("the branch with its tip at " + place_text(tip) + " " + why);
}

OpeningPlace place_by_itself(const BranchFromTip& branch, const Vec3& tip) {
    const double end = std::max(branch.own_length(), 0.25 * branch.length);
    double first = 0.5 * kSearchStep * branch.radius;
    while (first < end && !branch.is_whole(first)) first += kSearchStep * branch.radius;
    if (first >= end)
        fail(tip,
             "has no whole section before its furcation: remove it (remove-branch), or give the "
             "distance from its tip");
    first = std::min(first + kMargin * branch.radius, 0.5 * (first + end));
    std::optional<OpeningPlace> best;
    double least = 0.0;
    for (int k = 0; k < kCandidates; ++k) {
        const double s = first + k * kCandidateStep * branch.radius;
        if (s > end) break;
        const auto place = branch.place(s);
        if (!place) continue;
        const double cost =
            place->bend_deg + place->tilt_deg + kCostPerRadius * (s - first) / branch.radius;
        if (best && cost >= least) continue;
        best = place;
        least = cost;
    }
    if (!best) fail(tip, "has no closed section: give the distance from its tip");
    return *best;
}

}  // namespace

OpeningPlace choose_opening_place(const Surface& surface, const CenterlineGraph& graph,
                                  std::size_t tip, std::optional<double> distance) {
    const Vec3 at = graph.nodes.at(tip).position;
    const BranchFromTip branch(surface, graph, tip);
    if (!distance) return place_by_itself(branch, at);
    if (*distance > branch.length)
        fail(at, "is only " + std::to_string(branch.length) + " mm long: choose a distance below");
    const auto place = branch.place(*distance);
    if (!place)
        fail(at, "has no closed section " + std::to_string(*distance) +
                     " mm from its tip: choose another distance");
    return *place;
}

std::string place_text(const Vec3& point) {
    char text[96];
    std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f) mm", point.x(), point.y(), point.z());
    return text;
}

}  // namespace vesselbench
