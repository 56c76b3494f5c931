#pragma once

#include <optional>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// The smallest closed curve that encloses the plane's point: a vessel's whole section there.
[[nodiscard]] inline std::optional<SectionCurve> whole_section_at(const Surface& surface,
                                                                  const Plane& plane) {
    auto curve = cross_section_at(surface, plane);
    if (curve && !(curve->closed && encloses(*curve, plane, plane.point))) curve.reset();
    return curve;
}

}  // namespace vesselbench
