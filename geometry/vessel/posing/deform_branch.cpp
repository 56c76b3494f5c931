#include "geometry/vessel/posing/deform_branch.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/posing/pose_check.h"
#include "geometry/vessel/posing/rod_energy.h"

namespace vesselbench {

namespace {

constexpr double kNear = 2.5;         ///< of a place that means a branch, from its line [radii]
constexpr double kReach = 8.0;        ///< default [radii]
constexpr double kReachOfMove = 2.0;  ///< default, at least [lengths of the move]
constexpr double kFade = 0.25;        ///< of the flexibility [reach]
constexpr double kElement = 0.4;      ///< [radii]
constexpr std::size_t kMostElements = 120;
constexpr double kLoadStep = 0.5;  ///< part of a move before the next one [radii]
constexpr int kFewSteps = 2;       ///< to follow a part of the move
constexpr int kMostSteps = 60;     ///< until the least energy
constexpr double kAtPlace = 1e-4;  ///< distance that counts as none [radii]
constexpr double kAtRest = 1e-4;   ///< turn that counts as none [rad]

struct Chosen {
    std::size_t branch = 0;
    double abscissa = 0.0, radius = 0.0;
};

/// The branch in whose vessel the point is, or on whose wall.
Chosen branch_here(const CenterlineGraph& graph, const Vec3& at) {
    std::optional<Chosen> chosen;
    double least = kNear;
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const auto near = nearest_place(graph, b, at);
        if (!near) continue;
        const double radius = radius_at(graph.branches[b], near->place.abscissa);
        if (near->distance >= least * radius) continue;
        least = near->distance / radius;
        chosen = {b, near->place.abscissa, radius};
    }
    if (!chosen) throw DiagnosedFailure({.code = "no-branch-here", .place = at});
    return *chosen;
}

/// Bends that take this share of the turns away.
Bends straightening(const Rod& rod, double share) {
    Bends bends;
    for (const RodElement& element : rod.elements) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = element.first; i < element.last; ++i) {
            const Vec3 &before = rod.tangent(i), &after = rod.tangent(i + 1);
            const Vec3 axis = before.cross(after);
            if (axis.norm() > 0.0)
                sum -= std::atan2(axis.norm(), before.dot(after)) * axis.normalized();
        }
        bends.push_back(share * element.flexibility * sum);
    }
    return bends;
}

double sharpest_of(const Rod& rod, const RodPose& pose) {
    double sharpest = std::numeric_limits<double>::infinity();
    for (std::size_t i = rod.begin + 5; i + 5 <= rod.end; ++i) {
        const Vec3 before = pose.points[i] - pose.points[i - 5],
                   after = pose.points[i + 5] - pose.points[i];
        const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
        const double length = 0.5 * (rod.along()[i + 5] - rod.along()[i - 5]);
        if (turn > 0.0) sharpest = std::min(sharpest, length / turn / rod.radii()[i]);
    }
    return sharpest;
}

class Deforming {
public:
    Deforming(const Surface& surface, const CenterlineGraph& graph,
              const BranchDeformation& deformation, const Progress& progress)
        : surface_(surface),
          deformation_(deformation),
          chosen_(branch_here(graph, deformation.at)) {
        reach_ = deformation.reach.value_or(
            std::max(kReach * chosen_.radius, kReachOfMove * deformation.move.norm()));
        armature_ = make_armature(surface, graph, {chosen_.branch}, progress);
        if (armature_.rods.empty()) throw_stiff(armature_.stiff.front());
        Rod& rod = armature_.rods.front();
        const bool reversed = graph.branches[chosen_.branch].start_node != rod.root_node;
        at_ = std::clamp(reversed ? branch_length(graph.branches[chosen_.branch]) - chosen_.abscissa
                                  : chosen_.abscissa,
                         0.0, rod.length());
        const double bends = 2.0 * reach_;
        divide(rod, at_ - reach_, at_ + reach_, kFade * reach_,
               std::max(kElement * chosen_.radius, bends / kMostElements));
        if (rod.elements.empty() ||
            (rod.along()[rod.elements.front().first] >= at_ && deformation.move != Vec3::Zero()))
            throw DiagnosedFailure({.code = "place-is-rigid", .place = deformation.at});
    }

    DeformedBranch run(const Progress& progress) {
        const Rod& rod = armature_.rods.front();
        const Bends natural = straightening(rod, deformation_.straighten);
        RodEnergy energy(armature_, natural, [&](double) { return reach_; });
        const AxisPlace place = rod.at(at_);
        const Binding at{
            .rod = 0, .segment = static_cast<std::uint32_t>(place.segment), .t = place.t};
        const Vec3 rest = rod.centre(place);
        if (deformation_.move != Vec3::Zero()) pull(energy, at, rest, progress);
        return finish(energy, at, rest, progress);
    }

private:
    void pull(RodEnergy& energy, const Binding& at, const Vec3& rest, const Progress& progress) {
        const Vec3 start = carried(energy.poses(), armature_, at, rest);
        const int loads = std::max(1, static_cast<int>(std::ceil(deformation_.move.norm() /
                                                                 (kLoadStep * chosen_.radius))));
        RodPull pull{at, rest, start, course_at(energy.poses().front())};
        double missing = 0.0;
        for (int load = 1; load <= loads; ++load) {
            progress.report(0.2 + 0.5 * load / loads, "bending the branch");
            const Vec3 move = deformation_.move * load / loads;
            pull.to = start + move;
            energy.hold_displaced(0, at_, following() * move);
            const int steps = load < loads ? kFewSteps : kMostSteps;
            for (int i = 0; i < steps; ++i) {
                progress.check_cancelled();
                missing = energy.step(pull);
                if (missing < kAtPlace * chosen_.radius && energy.last_turn() < kAtRest) break;
            }
        }
        if (missing > 1e2 * kAtPlace * chosen_.radius)
            throw DiagnosedFailure(
                {.code = "move-not-reached",
                 .place = pull.to,
                 .figures = {{"move_mm", deformation_.move.norm()}, {"missing_mm", missing}},
                 .remedies = {{.arguments = {{"reach", ""}}}}});
    }

    /// Share of the move that the branch's free end shares: none beyond reach, where the branch
    /// returns to its course; all of it within half the reach, where returning would be a kink.
    [[nodiscard]] double following() const {
        const Rod& rod = armature_.rods.front();
        if (!rod.free_end) return 0.0;
        return std::clamp(2.0 * (1.0 - (rod.length() - at_) / reach_), 0.0, 1.0);
    }

    /// Unit direction of the branch at the place before it is moved.
    [[nodiscard]] Vec3 course_at(const RodPose& pose) const {
        const std::size_t i = armature_.rods.front().at(at_).segment;
        return (pose.points[i + 1] - pose.points[i]).normalized();
    }

    DeformedBranch finish(const RodEnergy& energy, const Binding& at, const Vec3& rest,
                          const Progress& progress) const {
        require_gentle(armature_, energy.poses());
        Positions moved = posed(surface_, armature_, energy.poses());
        progress.report(0.8, "looking for walls that cross");
        require_no_crossing(surface_, moved, progress);
        DeformedBranch result{.surface = {},
                              .reach = reach_,
                              .from = rest,
                              .to = carried(energy.poses(), armature_, at, rest),
                              .axis = bent_axes(armature_, energy.poses()).front()};
        result.sharpest_radii = sharpest_of(armature_.rods.front(), energy.poses().front());
        for (std::size_t v = 0; v < moved.size(); ++v) {
            const double shift = (moved[v] - surface_.points()[v]).norm();
            result.largest_shift = std::max(result.largest_shift, shift);
            if (shift > 0.0) ++result.moved_vertices;
        }
        result.surface = surface_.with_positions(std::move(moved));
        result.volume_before = volume(surface_);
        result.volume_after = volume(result.surface);
        return result;
    }

    const Surface& surface_;
    BranchDeformation deformation_;
    Chosen chosen_;
    double reach_ = 0.0, at_ = 0.0;
    Armature armature_;
};

}  // namespace

DeformedBranch deform_branch(const Surface& surface, const CenterlineGraph& graph,
                             const BranchDeformation& deformation, const Progress& progress) {
    if (!(deformation.straighten >= 0.0 && deformation.straighten <= 1.0))
        throw InvalidInput("straighten is a share from 0 to 1");
    if (!deformation.at.allFinite() || !deformation.move.allFinite())
        throw InvalidInput("the place and its move must be finite");
    if (deformation.move != Vec3::Zero())
        require_in_proportion("move", deformation.move.norm(), surface, 1.0);
    if (deformation.reach) require_positive("reach", *deformation.reach);
    return Deforming(surface, graph, deformation, progress.part(0.0, 1.0)).run(progress);
}

}  // namespace vesselbench
