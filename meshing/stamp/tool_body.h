#pragma once

#include <cstddef>
#include <span>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A closed body that is subtracted from a vessel or added to it.
struct ToolBody {
    Surface surface;             ///< closed, outward
    Vec3 centre = Vec3::Zero();  ///< of a ball around it [mm]
    double reach = 0.0;          ///< radius of that ball [mm]
    double thickness = 0.0;      ///< where it is thinnest [mm]
    double detail = 0.0;         ///< longest edge that follows its curvature [mm]
};

/// A box around its centre.
struct BoxTool {
    Vec3 centre = Vec3::Zero();      ///< [mm]
    Vec3 direction = Vec3::UnitZ();  ///< across which it is `thickness` thick; any length but 0
    Vec3 along = Vec3::UnitX();      ///< its length; made perpendicular to `direction`
    double thickness = 1.0;          ///< [mm], > 0
    double length = 1.0;             ///< [mm], > 0
    double width = 1.0;              ///< [mm], > 0
};

/// All points within `radius` of a segment.
struct CapsuleTool {
    Vec3 centre = Vec3::Zero();      ///< [mm]
    Vec3 direction = Vec3::UnitZ();  ///< of the segment; any length but 0
    double length = 0.0;             ///< of the segment [mm], >= 0
    double radius = 1.0;             ///< [mm], > 0
};

/// A regular polygon swept along a path: mitred at its corners.
struct SweptTool {
    std::span<const Vec3> path;  ///< [mm], two points or more
    std::size_t sides = 6;       ///< of the polygon, 3 ... 64
    double radius = 1.0;         ///< of its corners [mm], > 0
};

/// \throw InvalidInput if a length, a direction or a number is out of its range
[[nodiscard]] ToolBody box_body(const BoxTool& box);
[[nodiscard]] ToolBody capsule_body(const CapsuleTool& capsule);

/// \throw InvalidInput as above, also if the path turns back on itself or its turns are so tight
/// for the radius that the body would cross itself
[[nodiscard]] ToolBody swept_body(const SweptTool& swept);

}  // namespace vesselbench
