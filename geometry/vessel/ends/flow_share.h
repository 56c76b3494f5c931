#pragma once

#include <algorithm>
#include <cmath>

namespace vesselbench {

/// Share of a vessel's flow that another one takes [-]: the cube of their diameters' ratio, at most
/// 1; 0 where the vessel has no diameter.
/// Source: Murray, "The physiological principle of minimum work", PNAS 12, 1926.
/// \param diameter [mm]
/// \param reference diameter of the vessel whose flow is all of it [mm]
[[nodiscard]] inline double share_of_flow(double diameter, double reference) {
    return reference > 0.0 ? std::min(1.0, std::pow(diameter / reference, 3.0)) : 0.0;
}

}  // namespace vesselbench
