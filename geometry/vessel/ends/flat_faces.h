#pragma once

#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A planar face of the wall that closes a vessel, as where a mask, a crop or a capped model ends;
/// its rim may be rounded by smoothing.
struct FlatFace {
    Vec3 centre = Vec3::Zero();   ///< [mm]
    Vec3 normal = Vec3::UnitZ();  ///< unit, out of the vessel
    double radius = 0.0;          ///< of the vessel just behind it, the median over directions [mm]
    double length = 0.0;          ///< how far the vessel behind it stays as wide [mm]
    std::vector<TriangleId> triangles;  ///< connected, ascending
};

/// Discs of nearly one direction behind which a vessel is about as wide as they are, for more than
/// its radius, and ends: neither the top of a dome, nor a terrace of a staircase, nor a flat side,
/// nor the wall of a furcation. Caps with a label are left out.
/// \throw Cancelled
[[nodiscard]] std::vector<FlatFace> find_flat_faces(const Surface& surface,
                                                    const Progress& progress = {});

}  // namespace vesselbench
