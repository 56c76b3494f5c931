#include "geometry/vessel/sac/likely_sacs.h"

#include <algorithm>
#include <limits>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/sac/neck_plane.h"

namespace vesselbench {

namespace {

/// Squared distance from the nearest point [mm^2].
double nearest_squared(const Positions& points, const Vec3& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : points) least = std::min(least, (p - x).squaredNorm());
    return least;
}

/// True if the vertex nearest to the tip is the sac's.
bool holds(const SacPart& sac, const Surface& surface, const Vec3& tip) {
    return nearest_squared(sac.points, tip) <= nearest_squared(surface.points(), tip);
}

}  // namespace

std::vector<JudgedTip> tips_by_sac_odds(const Surface& surface,
                                        const std::optional<ImageBox>& image,
                                        const Progress& progress) {
    const auto graph = centerlines_of(surface, {}, progress.part(0.0, 0.6));
    std::vector<JudgedTip> tips =
        judged_tips(surface, *graph, *stubs_of(surface), image, progress.part(0.6, 1.0));
    std::ranges::stable_sort(tips, std::ranges::greater{},
                             [](const JudgedTip& tip) { return tip.verdict.odds.sac; });
    return tips;
}

bool is_likely_sac(const JudgedTip& tip) {
    return tip.verdict.odds.sac > 0.5;
}

std::optional<Vec3> dome_of_one_sac(const Surface& surface, const std::vector<JudgedTip>& tips,
                                    const Progress& progress) {
    for (const JudgedTip& dome : tips) try {
            const SacAtNeck neck = propose_neck(surface, dome.tip, progress);
            if (std::ranges::all_of(
                    tips, [&](const JudgedTip& tip) { return holds(neck.sac, surface, tip.tip); }))
                return dome.tip;
        } catch (const AlgorithmFailure&) {
            // It has no neck: another one may hold it.
        }
    return std::nullopt;
}

}  // namespace vesselbench
