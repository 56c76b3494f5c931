#include "workbench/flow/cycle_shear.h"

#include <algorithm>
#include <limits>

namespace vesselbench {

CycleShear cycle_shear(const Vec3& mean, double tawss) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (!(tawss > 0.0)) return {.rrt = kNone};
    CycleShear shear{.tawss = tawss};
    const double along = std::min(1.0, mean.norm() / tawss);
    shear.osi = 0.5 * (1.0 - along);
    shear.rrt = along > 0.0 ? 1.0 / (along * tawss) : kNone;
    shear.ecap = shear.osi / tawss;
    return shear;
}

}  // namespace vesselbench
