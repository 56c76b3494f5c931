#include "geometry/vessel/centerlines/lines_to_tip.h"

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"

namespace vesselbench {

std::shared_ptr<const CenterlineGraph> lines_to_tip(const Surface& surface, const Vec3& point,
                                                    double reach, const Progress& progress) {
    auto lines = centerlines_of(surface, {}, progress.part(0.0, 0.7));
    if (tip_near(*lines, point, reach)) return lines;
    return centerlines_of(surface, {.ends = {point}}, progress.part(0.7, 1.0));
}

}  // namespace vesselbench
