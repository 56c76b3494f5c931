#include "geometry/vessel/posing/part_branches.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/facing_walls.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/posing/pose_check.h"
#include "geometry/vessel/posing/rod_energy.h"

namespace vesselbench {

namespace {

constexpr double kReach = 12.0;        ///< over which a displacement fades [radii]
constexpr double kElement = 0.5;       ///< [radii]
constexpr double kMostElements = 180;  ///< of the whole tree, which bounds the time of a step
constexpr double kFade = 1.0;          ///< of the flexibility at furcations [radii]
constexpr double kAim = 1.02;          ///< of the gap, so that it is reached
/// What so few edges of the mesh connect is one fold at any distance: a crease has no gap.
constexpr double kCreaseEdges = 2.0;
constexpr double kSeen = 1.5;  ///< of the gap: walls that are held apart
constexpr std::size_t kMostContacts = 120;
constexpr int kMostRounds = 80;
constexpr int kPatience = 15;        ///< rounds without progress
constexpr double kProgress = 0.005;  ///< of the gap

using RodPair = std::pair<std::uint32_t, std::uint32_t>;

class Parting {
public:
    Parting(const Surface& surface, const CenterlineGraph& graph, double gap,
            const Progress& progress)
        : surface_(surface), gap_(gap) {
        std::vector<std::size_t> all(graph.branches.size());
        std::iota(all.begin(), all.end(), 0);
        armature_ = make_armature(surface, graph, all, progress);
        double total = 0.0;
        for (const Rod& rod : armature_.rods)
            total += rod.along()[rod.end] - rod.along()[rod.begin];
        for (Rod& rod : armature_.rods) {
            const double radius = rod.radii()[(rod.begin + rod.end) / 2];
            divide(rod, 0.0, rod.length(), kFade * radius,
                   std::max(kElement * radius, total / kMostElements));
        }
    }

    PartedBranches run(const Progress& progress) {
        PartedBranches result;
        now_ = surface_;
        std::vector<FacingWall> facing = facing_now(2.0);
        const auto before = smallest_by_pair(facing);
        RodEnergy energy(armature_, {}, [](double radius) { return kReach * radius; });
        double best = -1.0;
        int since = 0;
        while (!facing.empty() && facing.front().distance < gap_) {
            const double smallest = facing.front().distance;
            since = smallest > best + kProgress * gap_ ? 0 : since + 1;
            best = std::max(best, smallest);
            if (since > kPatience || ++result.rounds > kMostRounds || element_count(armature_) == 0)
                fail(facing.front());
            progress.report(0.8 * std::min(1.0, best / gap_), "pushing branches apart");
            const std::vector<RodGap> contacts = contacts_of(facing, energy.poses());
            energy.step(contacts);
            now_ = surface_.with_positions(posed(surface_, armature_, energy.poses()));
            facing = facing_now(2.0);
        }
        progress.report(0.8, "looking for walls that cross");
        require_gentle(armature_, energy.poses());
        require_no_crossing(surface_, now_.points(), progress);
        const auto after = smallest_by_pair(facing);
        for (const auto& [pair, wall] : before) {
            if (wall.distance >= gap_) continue;
            const auto found = after.find(pair);
            result.gaps.push_back({surface_.points()[wall.from], wall.to, wall.distance,
                                   found == after.end() ? 2.0 * gap_ : found->second.distance});
        }
        std::ranges::stable_sort(result.gaps, {}, &BranchGap::before);
        result.smallest_after = facing.empty() ? 2.0 * gap_ : facing.front().distance;
        result.shifts = shifts();
        result.volume_before = volume(surface_);
        result.volume_after = volume(now_);
        result.axes = bent_axes(armature_, energy.poses());
        result.surface = now_;
        return result;
    }

private:
    /// \param reach [gaps]
    [[nodiscard]] std::vector<FacingWall> facing_now(double reach) const {
        std::vector<FacingWall> walls =
            facing_walls(now_, SurfaceDistance(now_), FacingSide::Outside, reach * gap_);
        std::erase_if(walls, [&](const FacingWall& wall) {
            const double crease =
                kCreaseEdges * longest_edge(now_.points(), now_.triangles()[wall.triangle]);
            return is_fold(now_, wall, crease);
        });
        return walls;
    }

    [[nodiscard]] VertexId target(const FacingWall& wall) const {
        const Triangle& t = surface_.triangles()[wall.triangle];
        return *std::ranges::min_element(
            t, {}, [&](VertexId v) { return (now_.points()[v] - wall.to).squaredNorm(); });
    }

    [[nodiscard]] RodPair pair_of(const FacingWall& wall) const {
        const auto [low, high] =
            std::minmax({armature_.bindings[wall.from].rod, armature_.bindings[target(wall)].rod});
        return {low, high};
    }

    /// \param walls nearest first
    [[nodiscard]] std::map<RodPair, FacingWall> smallest_by_pair(
        const std::vector<FacingWall>& walls) const {
        std::map<RodPair, FacingWall> smallest;
        for (const FacingWall& wall : walls) smallest.try_emplace(pair_of(wall), wall);
        return smallest;
    }

    /// The nearest walls, at most one within half a gap of another.
    [[nodiscard]] std::vector<RodGap> contacts_of(const std::vector<FacingWall>& walls,
                                                  std::span<const RodPose> poses) const {
        std::vector<RodGap> contacts;
        Positions taken;
        for (const FacingWall& wall : walls) {
            if (wall.distance > kSeen * gap_ || contacts.size() == kMostContacts) break;
            const Vec3& place = now_.points()[wall.from];
            if (std::ranges::any_of(
                    taken, [&](const Vec3& other) { return (other - place).norm() < 0.5 * gap_; }))
                continue;
            taken.push_back(place);
            const Binding &from = armature_.bindings[wall.from],
                          &to = armature_.bindings[target(wall)];
            contacts.push_back({from, to, surface_.points()[wall.from],
                                carried_back(poses, armature_, to, wall.to), kAim * gap_});
        }
        return contacts;
    }

    [[noreturn]] void fail(const FacingWall& wall) const {
        throw DiagnosedFailure(
            {.code = "gap-not-reached",
             .place = surface_.points()[wall.from],
             .figures = {{"gap_mm", gap_}, {"reached_mm", wall.distance}},
             .remedies = {{.arguments = {{"gap", ""}}}, {.operation = "deform-branch"}}});
    }

    [[nodiscard]] std::vector<BranchShift> shifts() const {
        std::vector<BranchShift> all;
        for (const Rod& rod : armature_.rods) all.push_back({.end = rod.points().back()});
        for (VertexId v = 0; v < surface_.vertex_count(); ++v) {
            const std::uint32_t rod = armature_.bindings[v].rod;
            if (rod == Binding::kFixed) continue;
            const double shift = (now_.points()[v] - surface_.points()[v]).norm();
            if (shift <= all[rod].largest) continue;
            all[rod].largest = shift;
            all[rod].place = surface_.points()[v];
        }
        std::erase_if(all, [](const BranchShift& shift) { return shift.largest == 0.0; });
        std::ranges::stable_sort(all, std::greater<>(), &BranchShift::largest);
        return all;
    }

    const Surface& surface_;
    double gap_;
    Armature armature_;
    Surface now_;
};

}  // namespace

PartedBranches part_branches(const Surface& surface, const CenterlineGraph& graph, double gap,
                             const Progress& progress) {
    require_positive("gap", gap);
    require_in_proportion("gap", gap, surface, 1.0);
    return Parting(surface, graph, gap, progress).run(progress);
}

}  // namespace vesselbench
