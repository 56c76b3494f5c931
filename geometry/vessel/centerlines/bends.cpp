#include "geometry/vessel/centerlines/bends.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

std::optional<Bend> strongest_bend(const CenterlineGraph& graph) {
    std::optional<Bend> strongest;
    for (const CenterlineBranch& branch : graph.branches) {
        const std::vector<double> lengths = abscissas(branch);
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            const double reach = 2.0 * branch.radii[i];
            if (lengths[i] < reach || lengths[i] + reach > lengths.back()) continue;
            const Vec3 here = branch.points[i],
                       before = here - point_at(branch, lengths[i] - reach),
                       after = point_at(branch, lengths[i] + reach) - here;
            const double turn = std::atan2(before.cross(after).norm(), before.dot(after)) * 180.0 /
                                std::numbers::pi;
            if (!strongest || turn > strongest->turn_deg)
                strongest = Bend{here, turn, branch.radii[i]};
        }
    }
    return strongest;
}

}  // namespace vesselbench
