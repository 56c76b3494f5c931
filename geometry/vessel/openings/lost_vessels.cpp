#include "geometry/vessel/openings/lost_vessels.h"

#include <algorithm>
#include <functional>

#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/rim_shape.h"

namespace vesselbench {

namespace {

/// A longer stretch is missed [diameters].
constexpr double kLongestLoss = 3.0;
/// A centerline this far outside the wall has lost its vessel [radii]: editing moves walls a
/// little.
constexpr double kOutside = 0.3;
constexpr double kLeastRiseDegInWall = 30.0;

/// The longest stretch of a branch whose points are outside.
LostVessel longest_gap(const CenterlineBranch& branch, const std::vector<double>& distances) {
    const std::vector<double> s = abscissas(branch);
    LostVessel longest;
    for (std::size_t i = 0; i < s.size(); ++i) {
        std::size_t last = i;
        while (last < s.size() && distances[last] > kOutside * branch.radii[last]) ++last;
        if (last == i) continue;
        const double length = s[last - 1] - s[i];
        if (length > longest.length) {
            const std::size_t middle = (i + last - 1) / 2;
            longest = {branch.points[middle], length, 2.0 * branch.radii[middle]};
        }
        i = last;
    }
    return longest;
}

bool had(const Surface& before, const Surface& after, std::size_t patch) {
    const PatchShape shape = patch_shape(after, patch);
    for (std::size_t p = 0; p < before.patches.size(); ++p) {
        if (before.patches[p].kind == PatchKind::Wall ||
            std::ranges::find(*before.patch_labels, p) == before.patch_labels->end())
            continue;
        const Vec3 apart = patch_shape(before, p).plane.point - shape.plane.point;
        if (apart.norm() < 0.1 * shape.diameter()) return true;
    }
    return false;
}

}  // namespace

std::vector<LostVessel> lost_vessels(const CenterlineGraph& before, const Surface& after) {
    const SurfaceDistance wall(after);
    std::vector<LostVessel> lost;
    for (const CenterlineBranch& branch : before.branches) {
        const LostVessel gap = longest_gap(branch, wall.signed_distances(branch.points));
        if (gap.length > kLongestLoss * gap.diameter) lost.push_back(gap);
    }
    std::ranges::stable_sort(lost, std::greater{}, &LostVessel::diameter);
    return lost;
}

std::vector<std::size_t> openings_in_walls(const Surface& before, const Surface& after) {
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < after.patches.size(); ++p) {
        if (after.patches[p].kind == PatchKind::Wall ||
            std::ranges::find(*after.patch_labels, p) == after.patch_labels->end() ||
            had(before, after, p))
            continue;
        const auto rim = rim_shape_of_cap(after, p);
        if (rim && rim->rise_deg < kLeastRiseDegInWall) found.push_back(p);
    }
    return found;
}

}  // namespace vesselbench
