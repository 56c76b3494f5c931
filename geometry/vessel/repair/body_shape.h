#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How a closed body looks from inside.
struct BodyShape {
    double area = 0.0;           ///< [mm^2]
    Vec3 centre = Vec3::Zero();  ///< of its box [mm]
    Vec3 size = Vec3::Zero();    ///< of its box [mm]
    /// Fraction of its area [-] behind which it is about as wide, in some direction across, as it
    /// is deep: of tubes and chambers nearly all, of plates and ribs only the edges.
    double round = 0.0;

    [[nodiscard]] bool may_be_vessel() const { return round > 0.5; }
};

/// \param body closed, and consistently oriented to either side
/// \throw InvalidInput if it has no triangle
[[nodiscard]] BodyShape body_shape(const Surface& body);

}  // namespace vesselbench
